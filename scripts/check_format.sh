#!/usr/bin/env bash
# Compares all C++ files with .clang-format; `scripts/check_format.sh --fix` rewrites them.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

mapfile -t files < <(find include src apps python bench tests -name build -prune -o \
  \( -name '*.h' -o -name '*.cpp' \) -print 2>/dev/null)
[ ${#files[@]} -gt 0 ] || { echo "check_format: no C++ files found" >&2; exit 1; }
if [ "${1:-}" = --fix ]; then
  clang-format-14 -i "${files[@]}"
else
  clang-format-14 --dry-run --Werror "${files[@]}"
fi
echo "check_format: ${#files[@]} files"
