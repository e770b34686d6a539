#include "mechanics/strain_tie.h"

#include "mechanics/cell_table.h"
#include "mechanics/corner_modes.h"
#include "mechanics/corners.h"

namespace koshi::mechanics {
namespace {

// The six uniform strains by corner unknowns, n a node, each of length 1.
Eigen::MatrixXd uniform_strains(int n) {
  Eigen::MatrixXd strains = Eigen::MatrixXd::Zero(corner_count * n, 6);
  for (int v = 0; v < 6; ++v) {
    const auto i = static_cast<int>(tensor_axes[static_cast<std::size_t>(v)][0]),
               j = static_cast<int>(tensor_axes[static_cast<std::size_t>(v)][1]);
    for (int a = 0; a < corner_count; ++a) {
      strains(n * a + i, v) = mode_sign(a, 1 << j);
      strains(n * a + j, v) = mode_sign(a, 1 << i);
    }
    strains.col(v).normalize();
  }
  return strains;
}

}  // namespace

Tensor6 tie_stress(const material::Springs& springs, double d, const CellMotion& motion) {
  const CellConstants k = springs_of_cell(springs, d);
  const double body = k[4], turn = k[3] + k[5];  // bb and g of cell_strip.cpp, where the tie's terms stand
  // Sums over the corners with the signs of a mode; of rotations rho = (d/2) w.
  const auto amplitude = [](const std::array<Vec3, 8>& of, int component, int mode) {
    double sum = 0;
    for (int a = 0; a < corner_count; ++a)
      sum += mode_sign(a, mode) * of[static_cast<std::size_t>(a)][static_cast<std::size_t>(component)];
    return sum;
  };
  const auto rho = [&](int component, int mode) { return 0.5 * d * amplitude(motion.rotation, component, mode); };
  // The amplitude of a stretch is 4 d e_ii, that of a shear 8 d e_ij.
  Tensor6 stress{};
  for (int x = 0; x < 3; ++x) {
    const int y = (x + 1) % 3, z = (x + 2) % 3, X = 1 << x, Y = 1 << y, Z = 1 << z;
    const double shear = body * amplitude(motion.displacement, x, 7) + 0.5 * turn * (rho(y, X | Y) - rho(z, X | Z));
    stress[static_cast<std::size_t>(x)] = 4 / (d * d) * turn * (rho(z, X | Y) - rho(y, X | Z));
    stress[static_cast<std::size_t>(3 + x)] = 4 / (d * d) * shear;
  }
  return stress;
}

Eigen::MatrixXd without_tie(const Eigen::MatrixXd& K) {
  const Eigen::MatrixXd strains = uniform_strains(static_cast<int>(K.rows()) / corner_count);
  const Eigen::MatrixXd given = strains * (strains.transpose() * K);
  const Eigen::MatrixXd tie = given - given * strains * strains.transpose();
  return K - tie - tie.transpose();
}

}  // namespace koshi::mechanics
