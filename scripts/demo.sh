#!/usr/bin/env bash
# From a clean clone to the paper's two analyses: installs what building and running need, builds the program without
# its tests and the page of its reports, and runs `koshi paper`.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

stage() { printf 'demo: %s (%d:%02d)\n' "$1" $((SECONDS / 60)) $((SECONDS % 60)); }

stage "1 of 4, packages"
scripts/setup.sh run
stage "2 of 4, configuration"
cmake --preset release -DKOSHI_TESTS=OFF
stage "3 of 4, build"
# The page's tools come in meanwhile; only with them does the configuration include it.
scripts/setup.sh page &
page=$!
cmake --build --preset release --parallel "$(nproc)" --target koshi_app
wait "$page"
cmake --preset release -DKOSHI_TESTS=OFF >/dev/null
cmake --build --preset release --target koshi_report
stage "4 of 4, the paper's two analyses"
build/release/koshi paper --out out/paper
stage "done"
echo "The tables, curves and fields are in $PWD/out/paper: start with paper.md or open report.html."
