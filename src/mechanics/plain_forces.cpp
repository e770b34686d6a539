#include "mechanics/plain_forces.h"

#include <algorithm>

#include "mechanics/bond_law.h"
#include "mechanics/cell_bonds.h"
#include "mechanics/plain_rows.h"

namespace koshi::mechanics {
namespace {

Vec3 sign_of(int corner) { return {corner & 1 ? 1.0 : -1.0, corner & 2 ? 1.0 : -1.0, corner & 4 ? 1.0 : -1.0}; }

Vec3 at(const lattice::Field<double>& u, int component, std::int64_t node) {
  return {u.component(component)[node], u.component(component + 1)[node], u.component(component + 2)[node]};
}

}  // namespace

PlainForces::PlainForces(const model::SpringLattice& lattice)
    : lattice_(lattice), bond_(lattice.sharing == material::Sharing::plain ? lattice.bond : own_bond_) {
  if (lattice.sharing == material::Sharing::shared) make_bonds(lattice, own_bond_, own_bond_cells_);
  const auto any = [&lattice](auto&& has) { return std::any_of(lattice.springs.begin(), lattice.springs.end(), has); };
  for (int slot = 0; slot < lattice::slot_count; ++slot) {
    const int family = lattice::slots[slot].family;
    if (any([family](const material::Springs& s) { return s.kn[family] != 0 || s.kt[family] != 0; }))
      slots_.push_back(slot);
  }
  by_cell_ = lattice.components() == 3 || any([](const material::Springs& s) { return s.kappa != 0; });
}

// The bonds of each node, forwards and backwards.
void PlainForces::add_bonds(const lattice::Field<double>& u, std::int64_t first, double* const* force) const {
  for (const int slot : slots_)
    for (const int sign : {1, -1}) {
      const auto& s = lattice::slots[slot].s;
      const std::int64_t to = sign * lattice_.layout.offset(s), owner = sign > 0 ? first : first + to;
      const double d = -sign * lattice_.grid.d;
      plain_kernels().add_bonds(
          {u.component(0) + first,
           u.stride(),
           to,
           bond_.component(2 * slot) + owner,
           bond_.component(2 * slot + 1) + owner,
           {d * static_cast<double>(s[0]), d * static_cast<double>(s[1]), d * static_cast<double>(s[2])},
           force,
           lattice_.layout.owned()[0]},
          lattice_.components());
    }
}

// What belongs to the cells around each node: volumetric springs, and without node rotations what the cell's fitted
// rotation takes off its bonds.
void PlainForces::add_cells(const lattice::Field<double>& u, std::int64_t first, double* const* force) const {
  const lattice::Layout& layout = lattice_.layout;
  const double d = lattice_.grid.d;
  const std::uint16_t* const cell = lattice_.cell.component(0);
  const bool rotational = lattice_.components() == 6;
  std::array<std::int64_t, 8> corner_offset;
  for (int corner = 0; corner < 8; ++corner)
    corner_offset[corner] = layout.offset({corner & 1, corner >> 1 & 1, corner >> 2});

  for (std::int64_t i = 0; i < layout.owned()[0]; ++i)
    for (int own = 0; own < 8; ++own) {
      // The cell in which the node is corner `own`.
      const std::int64_t c = first + i - corner_offset[own];
      if (cell[c] == 0) continue;
      const double kappa = lattice_.factor_of(c) * lattice_.springs[cell[c]].kappa;
      if (rotational && kappa == 0) continue;
      std::array<Vec3, 8> corner;
      double theta = 0;
      Vec3 w{};
      for (int a = 0; a < 8; ++a) {
        corner[a] = at(u, 0, c + corner_offset[a]);
        theta += dot(sign_of(a), corner[a]) / (4 * d);
        w = w + (1 / (8 * d)) * cross(sign_of(a), corner[a]);
      }
      Vec3 F = (-kappa * d * d * theta / 4) * sign_of(own);
      if (!rotational) {
        // Moment of the bonds about w, and the node's own bonds. On a surface the parts of plain bonds are uneven, and
        // the moment does not vanish.
        Vec3 moment{}, arm{};
        for (const CellBond& bond : cell_bonds) {
          const double kt = cell_part(lattice_, bond.slot, c + corner_offset[bond.a], c).kt;
          const auto& s = lattice::slots[bond.slot].s;
          const Vec3 D = -d * Vec3{static_cast<double>(s[0]), static_cast<double>(s[1]), static_cast<double>(s[2])};
          moment = moment + kt * cross(D, corner[bond.a] - corner[bond.b] - cross(w, D));
          if (bond.a == own) arm = arm + kt * D;
          if (bond.b == own) arm = arm - kt * D;
        }
        F = F + cross(w, arm) + (1 / (8 * d)) * cross(moment, sign_of(own));
      }
      for (int x = 0; x < 3; ++x) force[x][i] += F[x];
    }
}

void PlainForces::row(const lattice::Field<double>& u, std::int64_t j, std::int64_t k, double* const* force) const {
  for (int c = 0; c < lattice_.components(); ++c) std::fill_n(force[c], lattice_.layout.owned()[0], 0.0);
  const std::int64_t first = lattice_.layout.index(0, j, k);
  add_bonds(u, first, force);
  if (by_cell_) add_cells(u, first, force);
}

}  // namespace koshi::mechanics
