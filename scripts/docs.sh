#!/usr/bin/env bash
# Builds the documentation site. A broken link, a page missing from the navigation, an equation that does not render
# and a wrong comment in a public header are errors.
# usage: docs.sh [DIRECTORY] [PROGRAM]   (default: build/site, build/release/koshi)
set -euo pipefail
root=$(dirname "$(dirname "$(realpath "${BASH_SOURCE[0]}")")")
site=$(realpath --canonicalize-missing "${1:-$root/build/site}")
program=$(realpath --canonicalize-missing "${2:-$root/build/release/koshi}")
cd "$root"
katex=/usr/share/javascript/katex
[ -x "$program" ] || { echo "docs: no program $program; build it first: cmake --build --preset release" >&2; exit 1; }

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# The pages: those of docs/, those the program tells, the C++ reference, and what stands at the root of the tree.
cp -R docs "$work/docs"
rm -r "$work/docs/doxygen"
/usr/bin/python3 scripts/docs_reference.py "$program" "$work/docs/reference"
doxygen - < <(cat docs/doxygen/Doxyfile; echo "OUTPUT_DIRECTORY = $work/docs/reference")
for page in CONTRIBUTING:contributing CHANGELOG:changes; do
  sed -e 's#](docs/development/#](#g' -e 's#](docs/#](../#g' -e 's#](CHANGELOG.md)#](changes.md)#g' \
    "${page%:*}.md" >"$work/docs/development/${page#*:}.md"
done

KOSHI_DOCS=$work/docs mkdocs build --strict --clean --site-dir "$site" 2>"$work/log" || { cat "$work/log" >&2; exit 1; }
if grep -A 50 'not included in the "nav"' "$work/log" >&2; then
  exit 1
fi
# Equations are rendered in the reader's browser, without a network.
cp -RL "$katex" "$site/"
node scripts/check_equations.js "$site" "$katex"
echo "docs: $(find "$site" -name '*.html' -not -path '*/cpp/*' | wc -l) pages in $site"
