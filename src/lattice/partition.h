// Partition of a box of nodes among ranks.
#pragma once

#include <vector>

#include "koshi/grid.h"

namespace koshi::lattice {

/// Boxes of nodes, one per rank, rank = px + dims_x (py + dims_y pz).
struct Partition {
  Int3 dims{1, 1, 1};
  /// Per axis the global index of each part's first node, and the number of nodes at the end; dims + 1 entries.
  std::array<std::vector<std::int64_t>, 3> borders;

  Int3 position(int rank) const { return {rank % dims[0], rank / dims[0] % dims[1], rank / (dims[0] * dims[1])}; }
  int rank(const Int3& p) const { return static_cast<int>(p[0] + dims[0] * (p[1] + dims[1] * p[2])); }
  Layout layout(int rank) const;
};

/// Splits the nodes into `ranks` boxes with the smallest surface. Inner borders are multiples of the largest power of
/// two (up to 16) that keeps the parts within an eighth of each other, so that merging 2x2x2 cells does not cross
/// ranks. Throws InputError when an axis cannot be split so that every rank owns a node.
Partition make_partition(const Grid& grid, int ranks);

}  // namespace koshi::lattice
