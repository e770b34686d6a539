#include "mechanics/plain_forces.h"

#include <algorithm>

#include "mechanics/bond_law.h"
#include "mechanics/cell_bonds.h"

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
}

// The bonds of each node, forwards and backwards: with node rotations their whole force, else that of the displacements
// without any rotation.
template <bool rotational>
void PlainForces::add_bonds(const lattice::Field<double>& u, std::int64_t first, double* const* force) const {
  const lattice::Layout& layout = lattice_.layout;
  const std::int64_t nodes = layout.owned()[0];
  for (int slot = 0; slot < lattice::slot_count; ++slot)
    for (const int sign : {1, -1}) {
      const auto& s = lattice::slots[slot].s;
      const Vec3 D = -sign * lattice_.grid.d *
                     Vec3{static_cast<double>(s[0]), static_cast<double>(s[1]), static_cast<double>(s[2])};
      const std::int64_t to = sign * layout.offset(s), owner = sign > 0 ? first : first + to;
      const double *const kn = bond_.component(2 * slot) + owner, *const kt = bond_.component(2 * slot + 1) + owner;
      std::array<const double*, 6> near{}, far{};
      for (int c = 0; c < (rotational ? 6 : 3); ++c) {
        near[c] = u.component(c) + first;
        far[c] = near[c] + to;
      }
      double *const fx = force[0], *const fy = force[1], *const fz = force[2];
      double *const mx = rotational ? force[3] : nullptr, *const my = rotational ? force[4] : nullptr,
                    *const mz = rotational ? force[5] : nullptr;
      // Several nodes at once: absent bonds have no stiffness.
#pragma GCC ivdep
      for (std::int64_t i = 0; i < nodes; ++i) {
        Vec3 w{};
        if constexpr (rotational)
          w = {0.5 * (near[3][i] + far[3][i]), 0.5 * (near[4][i] + far[4][i]), 0.5 * (near[5][i] + far[5][i])};
        const Vec3 r =
            relative_displacement({near[0][i], near[1][i], near[2][i]}, {far[0][i], far[1][i], far[2][i]}, w, D);
        const BondForce bond = bond_force(kn[i], kt[i], D, r);
        fx[i] -= bond.F[0];
        fy[i] -= bond.F[1];
        fz[i] -= bond.F[2];
        if constexpr (rotational) {
          mx[i] += bond.M[0];
          my[i] += bond.M[1];
          mz[i] += bond.M[2];
        }
      }
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
  lattice_.components() == 6 ? add_bonds<true>(u, first, force) : add_bonds<false>(u, first, force);
  add_cells(u, first, force);
}

}  // namespace koshi::mechanics
