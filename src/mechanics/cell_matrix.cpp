#include "mechanics/cell_matrix.h"

#include "koshi/vector3.h"
#include "mechanics/bond_law.h"

namespace koshi::mechanics {
namespace {

/// Displacements and rotation of a cell's corners; `unit` sets one unknown to 1.
struct Corners {
  std::array<Vec3, corner_count> u{};
  std::array<Vec3, corner_count> w{};
};

/// Gradient du_i/dx_j of the linear field fitted to the corners by least squares (N22): 1/(4d) sum_s s_j u_i(s).
std::array<Vec3, 3> least_squares_gradient(const Corners& corners, double d) {
  std::array<Vec3, 3> gradient{};
  for (int a = 0; a < corner_count; ++a)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) gradient[i][j] += (2 * corner(a)[j] - 1) * corners.u[a][i] / (4 * d);
  return gradient;
}

/// The corners with unknown `index` equal to 1, the others 0. The least-squares kinematics turns all corners with the
/// antisymmetric part of the cell's gradient, half the curl.
Corners unit(int index, double d, material::Kinematics kinematics) {
  Corners corners;
  const int component = index % components(kinematics), a = index / components(kinematics);
  if (component < 3)
    corners.u[a][component] = 1;
  else
    corners.w[a][component - 3] = 1;
  if (kinematics == material::Kinematics::least_squares) {
    const auto gradient = least_squares_gradient(corners, d);
    corners.w.fill({(gradient[2][1] - gradient[1][2]) / 2, (gradient[0][2] - gradient[2][0]) / 2,
                    (gradient[1][0] - gradient[0][1]) / 2});
  }
  return corners;
}

bool is_corner(const std::array<int, 3>& position) {
  for (const int coordinate : position)
    if (coordinate < 0 || coordinate > 1) return false;
  return true;
}

}  // namespace

Eigen::MatrixXd cell_matrix(const material::Springs& springs, double d, material::Kinematics kinematics) {
  const int size = corner_count * components(kinematics);
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(size, size);
  Eigen::MatrixXd r(3, size), F(3, size);

  // Each bond adds its share of (dr/dq)^T dF/dq: column q holds r and F when unknown q is 1.
  for (const lattice::Slot& slot : lattice::slots) {
    const double share = 1.0 / lattice::cells_per_bond[slot.family];
    const double kn = share * springs.kn[slot.family], kt = share * springs.kt[slot.family];
    const Vec3 D{-d * slot.s[0], -d * slot.s[1], -d * slot.s[2]};
    for (int a1 = 0; a1 < corner_count; ++a1) {
      const auto [x, y, z] = corner(a1);
      const std::array<int, 3> end{x + slot.s[0], y + slot.s[1], z + slot.s[2]};
      if (!is_corner(end)) continue;
      const int a2 = end[0] + 2 * end[1] + 4 * end[2];
      for (int q = 0; q < size; ++q) {
        const Corners c = unit(q, d, kinematics);
        const Vec3 rq = relative_displacement(c.u[a1], c.u[a2], 0.5 * (c.w[a1] + c.w[a2]), D);
        const Vec3 Fq = bond_force(kn, kt, D, rq);
        for (int i = 0; i < 3; ++i) {
          r(i, q) = rq[i];
          F(i, q) = Fq[i];
        }
      }
      K += r.transpose() * F;
    }
  }

  // Volumetric spring: energy 1/2 kappa d^3 theta^2, theta = trace of the gradient.
  Eigen::RowVectorXd theta(size);
  for (int q = 0; q < size; ++q) {
    const auto gradient = least_squares_gradient(unit(q, d, kinematics), d);
    theta(q) = gradient[0][0] + gradient[1][1] + gradient[2][2];
  }
  K += springs.kappa * d * d * d * theta.transpose() * theta;
  return 0.5 * (K + K.transpose());
}

}  // namespace koshi::mechanics
