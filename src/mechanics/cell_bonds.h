// The bonds of one cell of a body, with the part of each that belongs to the cell.
#pragma once

#include <array>

#include "koshi/spring_lattice.h"

namespace koshi::mechanics {

/// One of the 28 bonds of a cell between corners a and b (corner = x + 2 y + 4 z); D = x_a - x_b = -d s.
struct CellBond {
  int a, b;
  int slot;
};

/// 12 edges, 12 face diagonals, 4 body diagonals; corner b = corner a + slots[slot].s.
constexpr std::array<CellBond, 28> make_cell_bonds() {
  std::array<CellBond, 28> bonds{};
  std::size_t count = 0;
  for (int slot = 0; slot < lattice::slot_count; ++slot)
    for (int a = 0; a < 8; ++a) {
      int b = 0;
      bool inside = true;
      for (int axis = 0; axis < 3; ++axis) {
        const int at = (a >> axis & 1) + lattice::slots[slot].s[axis];
        inside = inside && (at == 0 || at == 1);
        b += at << axis;
      }
      if (inside) bonds[count++] = {a, b, slot};
    }
  return bonds;
}
inline constexpr std::array<CellBond, 28> cell_bonds = make_cell_bonds();

struct Stiffness {
  double kn, kt;  ///< [N/m]
};

/// A cell's part of a whole bond with shared springs: the material's stiffness over the number of cells in the bulk,
/// times the cell's factor.
inline Stiffness shared_part(const model::SpringLattice& body, lattice::Family family, std::int64_t cell) {
  const material::Springs& springs = body.springs[body.cell.component(0)[cell]];
  const double share = body.factor_of(cell) / lattice::cells_per_bond[family];
  return {share * springs.kn[family], share * springs.kt[family]};
}

/// The cell's part of a bond whose first node is `node`; `cell` is the index of its lowest corner. Shared springs: as
/// above, and nothing of broken bonds. Plain springs: the bond's stiffness over its solid cells.
inline Stiffness cell_part(const model::SpringLattice& body, int slot, std::int64_t node, std::int64_t cell) {
  if (body.sharing == material::Sharing::shared) {
    if (body.is_broken(slot, node)) return {0, 0};
    return shared_part(body, lattice::slots[slot].family, cell);
  }
  const double cells = body.bond_cells.component(slot)[node];
  if (cells == 0) return {0, 0};
  return {body.bond.component(2 * slot)[node] / cells, body.bond.component(2 * slot + 1)[node] / cells};
}

}  // namespace koshi::mechanics
