// Benchmarks of the explicit step and of the machine under it. Times are processor times of one rank: compare figures
// of one run, and quote medians (--benchmark_repetitions=5 --benchmark_report_aggregates_only=true).
#include <benchmark/benchmark.h>

#include "koshi/communicator.h"

int main(int argc, char** argv) {
  const koshi::Environment environment(&argc, &argv);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
