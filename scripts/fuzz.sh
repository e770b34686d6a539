#!/usr/bin/env bash
# Runs every fuzz target for a while, starting from its corpus in tests/fuzz/corpus.
# usage: fuzz.sh [SECONDS]   (per target, default 60)
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
seconds=${1:-60}

# Open MPI's own leaks at the end of a process are not what is looked for.
export ASAN_OPTIONS=detect_leaks=0
cmake --preset fuzz
cmake --build --preset fuzz --parallel "$(nproc)"
for source in tests/fuzz/fuzz_*.cpp; do
  target=$(basename "$source" .cpp)
  found=out/fuzz/$target # new inputs and, if any, the crashing one
  mkdir -p "$found"
  echo "$target: $seconds s"
  "build/fuzz/tests/fuzz/$target" -seed=1 -max_total_time="$seconds" -timeout=300 -rss_limit_mb=4096 \
    -artifact_prefix="$found/" -print_final_stats=1 "$found" "tests/fuzz/corpus/${target#fuzz_}"
done
