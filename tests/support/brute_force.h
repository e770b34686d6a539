// Independent oracle for internal forces: loops over cells and their bonds with the bond law, scattering to both ends.
// Knows nothing of rows or amplitudes; slow.
#pragma once

#include <array>
#include <map>
#include <vector>

#include "koshi/spring_lattice.h"
#include "mechanics/bond_law.h"

namespace koshi::test {

struct BruteForce {
  /// Force and moment (or force alone) per global node, and the elastic energy.
  std::vector<std::array<double, 6>> force;
  double energy = 0;
};

/// `u` by global node, x fastest; one rank only.
inline BruteForce brute_force(const model::SpringLattice& body, const std::vector<std::array<double, 6>>& u) {
  using lattice::slots;
  const lattice::Grid& grid = body.grid;
  const Int3 n = grid.nodes();
  const bool rotational = body.kinematics == material::Kinematics::rotational;
  const double d = grid.d;
  const std::uint16_t* cells = body.cell.component(0);
  const auto node_id = [&](Int3 p) {
    for (int a = 0; a < 3; ++a)
      if (grid.periodic[a]) p[a] = (p[a] + n[a]) % n[a];
    return static_cast<std::size_t>(p[0] + n[0] * (p[1] + n[1] * p[2]));
  };
  const auto material = [&](Int3 c) -> int {
    for (int a = 0; a < 3; ++a) {
      if (grid.periodic[a]) c[a] = (c[a] + grid.cells[a]) % grid.cells[a];
      if (c[a] < 0 || c[a] >= grid.cells[a]) return 0;
    }
    return cells[body.layout.index(c)];
  };
  BruteForce result;
  result.force.resize(u.size());

  for (std::int64_t z = 0; z < grid.cells[2]; ++z)
    for (std::int64_t y = 0; y < grid.cells[1]; ++y)
      for (std::int64_t x = 0; x < grid.cells[0]; ++x) {
        const int m = material({x, y, z});
        if (m == 0) continue;
        const material::Springs& springs = body.springs[static_cast<std::size_t>(m)];
        std::array<std::size_t, 8> id;
        std::array<Vec3, 8> at, disp;
        for (int a = 0; a < 8; ++a) {
          const Int3 p{x + (a & 1), y + (a >> 1 & 1), z + (a >> 2)};
          id[a] = node_id(p);
          at[a] = d * Vec3{static_cast<double>(a & 1), static_cast<double>(a >> 1 & 1), static_cast<double>(a >> 2)};
          disp[a] = {u[id[a]][0], u[id[a]][1], u[id[a]][2]};
        }
        const auto sign = [&](int a, int axis) { return a >> axis & 1 ? 1.0 : -1.0; };
        // Gradient of the least-squares field and the cell's rotation and dilatation.
        double G[3][3] = {};
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j)
            for (int a = 0; a < 8; ++a) G[i][j] += sign(a, j) * disp[a][i] / (4 * d);
        const Vec3 fitted{0.5 * (G[2][1] - G[1][2]), 0.5 * (G[0][2] - G[2][0]), 0.5 * (G[1][0] - G[0][1])};
        const double theta = G[0][0] + G[1][1] + G[2][2];
        result.energy += 0.5 * springs.kappa * d * d * d * theta * theta;
        Vec3 moment{};  // sum of D x F, minus the derivative of the energy by the fitted rotation

        for (int a = 0; a < 8; ++a)
          for (int b = 0; b < a; ++b) {
            const Vec3 D = at[a] - at[b];
            std::array<int, 3> s;
            int family = -1;
            for (int i = 0; i < 3; ++i) {
              s[i] = static_cast<int>(std::lround(-D[i] / d));  // from a to b
              family += s[i] != 0;
            }
            // Cells around the bond: the bond's direction fixes the cell along its axes, both sides count across.
            int solid = 0, places = 0;
            double kn = 0, kt = 0;
            for (int q = 0; q < 8; ++q) {
              Int3 c{x, y, z};
              bool same_corner = true;
              for (int i = 0; i < 3; ++i) {
                const int side = q >> i & 1;
                if (s[i] != 0 && side) same_corner = false;
                if (s[i] == 0 && side) c[i] += (a >> i & 1) ? 1 : -1;
              }
              if (!same_corner) continue;
              ++places;
              const int other = material(c);
              if (other == 0) continue;
              ++solid;
              kn += body.springs[static_cast<std::size_t>(other)].kn[family];
              kt += body.springs[static_cast<std::size_t>(other)].kt[family];
            }
            if (body.sharing == material::Sharing::shared) {
              kn = springs.kn[family] / places;
              kt = springs.kt[family] / places;
            } else {
              kn /= solid * solid;  // mean over the solid cells, split among them
              kt /= solid * solid;
            }
            const Vec3 w =
                !rotational
                    ? fitted
                    : 0.5 * (Vec3{u[id[a]][3], u[id[a]][4], u[id[a]][5]} + Vec3{u[id[b]][3], u[id[b]][4], u[id[b]][5]});
            const Vec3 r = mechanics::relative_displacement(disp[a], disp[b], w, D);
            const Vec3 F = mechanics::bond_force(kn, kt, D, r), M = mechanics::bond_moment(D, F);
            result.energy += mechanics::bond_energy(kn, kt, D, r);
            for (int i = 0; i < 3; ++i) {
              result.force[id[a]][i] -= F[i];
              result.force[id[b]][i] += F[i];
              if (rotational) {
                result.force[id[a]][3 + i] += M[i];
                result.force[id[b]][3 + i] += M[i];
              }
            }
            moment = moment + 2.0 * M;
          }
        for (int a = 0; a < 8; ++a) {
          const Vec3 s{sign(a, 0), sign(a, 1), sign(a, 2)};
          const Vec3 fit = rotational ? Vec3{} : (1 / (8 * d)) * cross(moment, s);
          for (int i = 0; i < 3; ++i) result.force[id[a]][i] += fit[i] - springs.kappa * d * d * theta / 4 * s[i];
        }
      }
  return result;
}

}  // namespace koshi::test
