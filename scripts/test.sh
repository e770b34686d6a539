#!/usr/bin/env bash
# Everything that must hold before a change lands: include graph, file sizes, format, build, all tests.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/setup.sh
/usr/bin/python3 scripts/check_includes.py
/usr/bin/python3 scripts/check_size.py
scripts/check_format.sh
cmake --preset release
cmake --build --preset release --parallel "$(nproc)"
# The C++, Python, report, documentation and packaging tests are all registered with CTest.
ctest --preset release --parallel "$(nproc)"
# The readers of input and checkpoints, sanitized, against three seconds of inputs made up for each.
scripts/fuzz.sh 3
