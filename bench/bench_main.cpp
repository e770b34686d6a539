// Benchmarks of the explicit step and of the machine under it, on as many ranks as the program is started with
// (mpiexec -n 2 koshi_bench). Rates are those of the whole body and of wall time; bench/table.py makes a table of them.
#include <benchmark/benchmark.h>

#include <cstring>
#include <vector>

#include "koshi/communicator.h"

namespace {

// What the other ranks measure is the same.
class NoReport : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>&) override {}
};

}  // namespace

int main(int argc, char** argv) {
  const koshi::Environment environment(&argc, &argv);
  const koshi::Communicator world = koshi::Communicator::world();
  if (world.rank() != 0) {
    int kept = 0;
    for (int i = 0; i < argc; ++i)
      if (std::strncmp(argv[i], "--benchmark_out", std::strlen("--benchmark_out")) != 0) argv[kept++] = argv[i];
    argc = kept;
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::AddCustomContext("ranks", std::to_string(world.size()));
  NoReport none;
  if (world.rank() == 0)
    benchmark::RunSpecifiedBenchmarks();
  else
    benchmark::RunSpecifiedBenchmarks(&none);
  return 0;
}
