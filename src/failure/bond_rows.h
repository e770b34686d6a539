// A first look at the bonds of a row of nodes: how far the worst of each node is stretched and sheared. The same source
// (bond_rows.cpp) is compiled for several instruction sets; the widest one the processor has is chosen at run time.
#pragma once

#include <cstddef>
#include <cstdint>

namespace koshi::failure {

/// One slot of a row: its other ends lie `to` further, and x_1 - x_2 = D [m].
struct BondSlot {
  std::ptrdiff_t to;
  double D[3];
};

/// Displacements of a row of nodes: component c of node i at u[c component + i].
struct BondRow {
  const double* u;
  std::ptrdiff_t component;
};

/// For nodes 0 <= i < count the largest stretch of their forward bonds in these slots, at least 0; and, unless `shear`
/// is null, of the square of the shear, with the rotations of both ends.
using BondRows = void (*)(const BondRow& row, const BondSlot* slots, std::size_t slot_count, std::int64_t count,
                          double* stretch, double* shear);

/// The function for this processor.
BondRows bond_rows();

}  // namespace koshi::failure
