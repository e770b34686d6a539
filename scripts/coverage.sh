#!/usr/bin/env bash
# The lines of each room that the C++ tests reach (docs/development/testing.md): an hour on two cores.
# usage: coverage.sh [ctest options]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/setup.sh run page test
cmake --preset coverage
cmake --build --preset coverage --parallel "$(nproc)"
find build/coverage -name '*.gcda' -delete
ctest --preset coverage --parallel "$(nproc)" --exclude-regex '^(docs|house|install|example)[.]|^report_page$|FilesThatMayNotGrow' "$@"
gcovr --root . --filter src/ --filter apps/ build/coverage --json-summary build/coverage/summary.json
/usr/bin/python3 scripts/coverage_table.py build/coverage/summary.json
