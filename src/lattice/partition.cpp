#include "lattice/partition.h"

#include <fmt/format.h>

#include <limits>

#include "koshi/error.h"

namespace koshi::lattice {
namespace {

// Borders of `parts` parts of n nodes, inner ones multiples of `step`; empty when a part would hold no node or the
// largest part is more than an eighth above the mean.
std::vector<std::int64_t> borders_at(std::int64_t n, std::int64_t parts, std::int64_t step) {
  std::vector<std::int64_t> b(static_cast<std::size_t>(parts) + 1);
  b.back() = n;
  for (std::int64_t p = 1; p < parts; ++p) b[p] = (n * p / parts + step / 2) / step * step;
  for (std::int64_t p = 0; p < parts; ++p) {
    const std::int64_t width = b[p + 1] - b[p];
    if (width < 1) return {};
    if (step > 1 && 8 * width * parts > 9 * n) return {};
  }
  return b;
}

std::vector<std::int64_t> split(std::int64_t n, std::int64_t parts) {
  for (std::int64_t step = 16; step > 1; step /= 2)
    if (auto b = borders_at(n, parts, step); !b.empty()) return b;
  return borders_at(n, parts, 1);
}

}  // namespace

Layout Partition::layout(int rank) const {
  const Int3 p = position(rank);
  Int3 begin, owned;
  for (int a = 0; a < 3; ++a) {
    begin[a] = borders[a][p[a]];
    owned[a] = borders[a][p[a] + 1] - begin[a];
  }
  return {begin, owned};
}

Partition make_partition(const Grid& grid, int ranks) {
  const Int3 n = grid.nodes();
  Partition best;
  double smallest = std::numeric_limits<double>::max();
  // Every factorisation of the number of ranks; cuts across x cost a little more, since they break contiguous rows.
  for (std::int64_t px = 1; px <= ranks; ++px) {
    if (ranks % px != 0) continue;
    for (std::int64_t py = 1; py <= ranks / px; ++py) {
      if (ranks / px % py != 0) continue;
      const Int3 dims{px, py, ranks / px / py};
      if (dims[0] > n[0] || dims[1] > n[1] || dims[2] > n[2]) continue;
      const double cut = 1.5 * static_cast<double>((px - 1) * n[1] * n[2]) +
                         1.1 * static_cast<double>((py - 1) * n[0] * n[2]) +
                         static_cast<double>((dims[2] - 1) * n[0] * n[1]);
      if (cut >= smallest) continue;
      smallest = cut;
      best.dims = dims;
    }
  }
  if (smallest == std::numeric_limits<double>::max())
    throw InputError(fmt::format("{} ranks cannot share {} x {} x {} nodes; use fewer ranks", ranks, n[0], n[1], n[2]));
  for (int a = 0; a < 3; ++a) best.borders[a] = split(n[a], best.dims[a]);
  return best;
}

}  // namespace koshi::lattice
