#include "mechanics/cell_stress.h"

#include <cmath>

#include "mechanics/bond_law.h"
#include "mechanics/cell_bonds.h"
#include "mechanics/corners.h"
#include "mechanics/cut_forces.h"
#include "mechanics/strain_tie.h"

namespace koshi::mechanics {
namespace {

// Gradient of the fitted field, du_i/dx_j = 1/(4d) sum_s s_j u_i(s).
using Gradient = std::array<Vec3, 3>;

void add_corner(int a, const Vec3& u, double d, Gradient& G) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) G[i][j] += (a >> j & 1 ? 1 : -1) * u[i] / (4 * d);
}

Tensor6 symmetric(const Gradient& G) {
  Tensor6 strain;
  for (int v = 0; v < 6; ++v)
    strain[v] = 0.5 * (G[tensor_axes[v][0]][tensor_axes[v][1]] + G[tensor_axes[v][1]][tensor_axes[v][0]]);
  return strain;
}

}  // namespace

CellMotion cell_motion(const model::SpringLattice& body, const lattice::Field<double>& u, std::int64_t cell) {
  CellMotion motion;
  for (int a = 0; a < 8; ++a) {
    const std::int64_t node = cell + body.layout.offset(corner(a));
    for (int c = 0; c < 3; ++c) {
      motion.displacement[a][c] = u.component(c)[node];
      if (body.components() == 6) motion.rotation[a][c] = u.component(3 + c)[node];
    }
  }
  return motion;
}

Tensor6 cell_strain(const model::SpringLattice& body, const lattice::Field<double>& u, std::int64_t cell) {
  Gradient G{};
  for (int a = 0; a < 8; ++a) {
    const std::int64_t node = cell + body.layout.offset(corner(a));
    add_corner(a, {u.component(0)[node], u.component(1)[node], u.component(2)[node]}, body.grid.d, G);
  }
  return symmetric(G);
}

Tensor6 quick_cell_strain(const model::SpringLattice& body, const lattice::Field<double>& u, std::int64_t cell) {
  const std::int64_t y = body.layout.pitch(), z = body.layout.plane();
  Gradient G{};
  for (int i = 0; i < 3; ++i) {
    const double* const a = u.component(i) + cell;
    // Sums over the two nodes along x, and differences, of the four rows.
    const std::array<const double*, 4> row{a, a + y, a + z, a + y + z};
    std::array<double, 4> sum{}, difference{};
    for (std::size_t r = 0; r < 4; ++r) {
      sum[r] = row[r][1] + row[r][0];
      difference[r] = row[r][1] - row[r][0];
    }
    G[static_cast<std::size_t>(i)] =
        (0.25 / body.grid.d) * Vec3{(difference[0] + difference[1]) + (difference[2] + difference[3]),
                                    (sum[1] - sum[0]) + (sum[3] - sum[2]), (sum[2] - sum[0]) + (sum[3] - sum[1])};
  }
  return symmetric(G);
}

CellState cell_state(const model::SpringLattice& body, const CellMotion& motion, std::int64_t cell) {
  const double d = body.grid.d;
  const bool rotational = body.components() == 6;
  const auto& [displacement, rotation] = motion;
  Gradient G{};
  for (int a = 0; a < 8; ++a) add_corner(a, displacement[a], d, G);
  CellState state;
  state.strain = symmetric(G);
  state.rotation = {0.5 * (G[2][1] - G[1][2]), 0.5 * (G[0][2] - G[2][0]), 0.5 * (G[1][0] - G[0][1])};

  // Virial of the cell's bonds.
  const double volume = d * d * d;
  for (const CellBond& bond : cell_bonds) {
    const auto [kn, kt] = cell_part(body, bond.slot, cell + body.layout.offset(corner(bond.a)), cell);
    const auto& s = lattice::slots[bond.slot].s;
    const Vec3 D = -d * Vec3{static_cast<double>(s[0]), static_cast<double>(s[1]), static_cast<double>(s[2])};
    const Vec3 w = rotational ? 0.5 * (rotation[bond.a] + rotation[bond.b]) : state.rotation;
    const Vec3 r = relative_displacement(displacement[bond.a], displacement[bond.b], w, D);
    const Vec3 F = bond_force(kn, kt, D, r);
    state.energy += bond_energy(kn, kt, D, r) / volume;
    for (int v = 0; v < 6; ++v) {
      const auto [i, j] = tensor_axes[v];
      state.stress[v] += 0.5 * (D[i] * F[j] + D[j] * F[i]) / volume;
    }
  }
  const double kappa = body.factor_of(cell) * body.springs[body.cell.component(0)[cell]].kappa;
  const double pressure = kappa * (state.strain[0] + state.strain[1] + state.strain[2]);
  for (int v = 0; v < 3; ++v) {
    state.stress[v] += pressure;
    state.energy += 0.5 * pressure * state.strain[v];
  }
  // Less the tie of strain, where the kernel has none.
  if (!strain_is_tied(body)) {
    const Tensor6 tie = tie_stress(body.springs[body.cell.component(0)[cell]], d, motion);
    for (int v = 0; v < 6; ++v) {
      const double stress = body.factor_of(cell) * tie[v];
      state.stress[v] -= stress;
      state.energy -= (v < 3 ? 1 : 2) * stress * state.strain[v];
    }
  }
  // In a cell that a surface cuts what makes it smooth: virial and work of those forces.
  if (const model::SurfaceCell* at_surface = surface_cell(body, cell)) {
    const std::array<Vec3, 8> force = cut_forces(body, *at_surface, displacement);
    for (int a = 0; a < 8; ++a) {
      const auto at = corner(a);
      const Vec3& F = force[a];
      state.energy -= 0.5 * dot(displacement[a], F) / volume;
      for (int v = 0; v < 6; ++v) {
        const auto [i, j] = tensor_axes[v];
        state.stress[v] -= 0.5 * d * (at[i] * F[j] + at[j] * F[i]) / volume;
      }
    }
  }
  return state;
}

CellState cell_state(const model::SpringLattice& body, const lattice::Field<double>& u, std::int64_t cell) {
  return cell_state(body, cell_motion(body, u, cell), cell);
}

CellState material_state(const model::SpringLattice& body, const lattice::Field<double>& u, std::int64_t cell) {
  CellState state = cell_state(body, u, cell);
  const double share = 1 / body.fraction_of(cell);
  for (double& stress : state.stress) stress *= share;
  state.energy *= share;
  return state;
}

CellState node_state(const model::SpringLattice& body, const lattice::Field<double>& u, std::int64_t node) {
  // Cells that a surface cuts count where there is no whole one.
  std::array<std::int64_t, 8> cells{};
  std::size_t whole = 0, count = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const std::int64_t cell = node - body.layout.offset({corner & 1, corner >> 1 & 1, corner >> 2});
    if (body.cell.component(0)[cell] == 0) continue;
    cells[count++] = cell;
    if (body.fraction_of(cell) == 1) std::swap(cells[whole++], cells[count - 1]);
  }
  if (whole > 0) count = whole;
  CellState mean;
  for (std::size_t c = 0; c < count; ++c) {
    const CellState state = material_state(body, u, cells[c]);
    for (int v = 0; v < 6; ++v) {
      mean.strain[v] += state.strain[v];
      mean.stress[v] += state.stress[v];
    }
    mean.rotation = mean.rotation + state.rotation;
  }
  const double share = count == 0 ? 0 : 1.0 / static_cast<double>(count);
  for (int v = 0; v < 6; ++v) {
    mean.strain[v] *= share;
    mean.stress[v] *= share;
  }
  mean.rotation = share * mean.rotation;
  return mean;
}

}  // namespace koshi::mechanics
