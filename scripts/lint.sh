#!/usr/bin/env bash
# clang-tidy over the library and the program, warnings as errors.
# usage: lint.sh [FILE...]   (default: all of src and apps)
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

cmake --preset dev >/dev/null
if [ $# -eq 0 ]; then
  mapfile -t files < <(find src apps -name '*.cpp')
  set -- "${files[@]}"
fi
printf '%s\n' "$@" | xargs --max-procs="$(nproc)" --max-args=1 \
  clang-tidy-14 -p build/dev --quiet --warnings-as-errors='*' 2>/dev/null
echo "lint: $# files"
