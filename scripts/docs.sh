#!/usr/bin/env bash
# Builds the documentation site; a broken link or a page missing from the navigation is an error.
# usage: docs.sh [DIRECTORY]   (default: build/site)
set -euo pipefail
site=$(realpath --canonicalize-missing "${1:-$(dirname "${BASH_SOURCE[0]}")/../build/site}")
cd "$(dirname "${BASH_SOURCE[0]}")/.."

log=$(mktemp)
trap 'rm -f "$log"' EXIT
mkdocs build --strict --clean --site-dir "$site" 2>"$log" || { cat "$log" >&2; exit 1; }
if grep -A 50 'not included in the "nav"' "$log" >&2; then
  exit 1
fi
# Equations are rendered in the reader's browser, without a network.
cp -RL /usr/share/javascript/katex "$site/"
echo "docs: $(find "$site" -name '*.html' | wc -l) pages in $site"
