#include "koshi/calibration.h"

namespace koshi::material {
namespace {

/// One group per slot the unit cell has, with the count given by `count(slot)`.
template <typename Count>
std::vector<BondGroup> groups(lattice::CellType cell, double d, const Springs& springs, Count count) {
  std::vector<BondGroup> bonds;
  for (const lattice::Slot& slot : lattice::slots) {
    if (slot.family >= lattice::families_of(cell)) continue;
    // The bond runs from n (node 1) to n + s (node 2).
    const Vec3 D{-d * slot.s[0], -d * slot.s[1], -d * slot.s[2]};
    bonds.push_back({D, count(slot), springs.kn[slot.family], springs.kt[slot.family]});
  }
  return bonds;
}

}  // namespace

std::vector<BondGroup> bulk_bonds(lattice::CellType cell, double d, const Springs& springs) {
  return groups(cell, d, springs, [](const lattice::Slot&) { return 1.0; });
}

std::vector<BondGroup> box_bonds(lattice::CellType cell, Sharing sharing, const Int3& cells, double d,
                                 const Springs& springs) {
  return groups(cell, d, springs, [&](const lattice::Slot& slot) {
    // Along an axis the bond runs along, it starts in each of the n cells; across it, on each of the n + 1 nodes.
    // Every cell owns one bond of each slot: 4 edges of 1/4, 2 face diagonals of 1/2, 1 body diagonal.
    double count = 1;
    for (int axis = 0; axis < 3; ++axis)
      count *= static_cast<double>(cells[axis] + (sharing == Sharing::plain && slot.s[axis] == 0 ? 1 : 0));
    return count;
  });
}

double box_volume(const Int3& cells, double d) {
  return static_cast<double>(cells[0]) * static_cast<double>(cells[1]) * static_cast<double>(cells[2]) * d * d * d;
}

ElasticTensor lattice_tensor(const Springs& springs, double d) {
  // Families a smaller cell lacks have no stiffness.
  return lattice_tensor(bulk_bonds(lattice::CellType::cube_iii, d, springs), d * d * d, springs.kappa);
}

}  // namespace koshi::material
