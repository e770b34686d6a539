#!/usr/bin/env bash
# From a clean clone to the paper's two analyses: installs what is missing, builds, and runs `koshi paper`.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/setup.sh
cmake --preset release
cmake --build --preset release --parallel "$(nproc)" --target koshi_app koshi_report
build/release/koshi paper --out out/paper
echo "The tables, curves and fields are in $PWD/out/paper: start with paper.md or open report.html."
