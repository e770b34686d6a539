// What the machine can do: memory bandwidth (triad) and fused multiply-adds on one core, or of all ranks together.
#include <benchmark/benchmark.h>

#include <cstdint>

#include <vector>

#include "koshi/communicator.h"

namespace {

// Ranks begin together, and take the same time.
double ranks() {
  const koshi::Communicator world = koshi::Communicator::world();
  return static_cast<double>(world.sum(std::int64_t{1}));
}

void triad(benchmark::State& state) {
  const std::size_t n = 40'000'000 / 8 * 8;  // three arrays of 320 MB, far beyond any cache
  std::vector<double> a(n, 1), b(n, 2), c(n, 3);
  const double together = ranks();
  for (auto _ : state) {
    double* __restrict pa = a.data();
    const double *pb = b.data(), *pc = c.data();
    for (std::size_t i = 0; i < n; ++i) pa[i] = pb[i] + 0.5 * pc[i];
    benchmark::DoNotOptimize(a.data());
    benchmark::ClobberMemory();
  }
  // Two reads and a write; the line that is written is read first, which is not counted.
  state.counters["GB/s"] =
      benchmark::Counter(24.0 * together * static_cast<double>(n) * static_cast<double>(state.iterations()) / 1e9,
                         benchmark::Counter::kIsRate);
}
BENCHMARK(triad)->Unit(benchmark::kMillisecond)->UseRealTime()->Iterations(20);

void fused_multiply_add(benchmark::State& state) {
  using Vector __attribute__((vector_size(64))) = double;
  constexpr int chains = 12, steps = 100'000;
  Vector x[chains];
  for (int c = 0; c < chains; ++c) x[c] = Vector{} + 0.1 * c;
  Vector m = Vector{} + 0.999, a = Vector{} + 0.001;
  benchmark::DoNotOptimize(m);
  const double together = ranks();
  for (auto _ : state) {
    for (int s = 0; s < steps; ++s)
      for (int c = 0; c < chains; ++c) x[c] = x[c] * m + a;
    benchmark::DoNotOptimize(x);
  }
  state.counters["GFLOP/s"] = benchmark::Counter(
      2.0 * 8 * chains * steps * together * static_cast<double>(state.iterations()) / 1e9, benchmark::Counter::kIsRate);
}
BENCHMARK(fused_multiply_add)->Unit(benchmark::kMillisecond)->UseRealTime()->Iterations(2000);

}  // namespace
