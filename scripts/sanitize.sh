#!/usr/bin/env bash
# Builds the program and its tests with the address and undefined-behaviour sanitizers and runs them: half an hour on
# two cores. Left out is what runs no code of its own under them: pages, pictures, packages and the gallery, whose
# examples run for minutes each.
# usage: sanitize.sh [ctest options]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/setup.sh run page test
cmake --preset asan
cmake --build --preset asan --parallel "$(nproc)"
ctest --preset asan --parallel "$(nproc)" --exclude-regex '^(docs|house|install|example)[.]|^report_page$' "$@"
