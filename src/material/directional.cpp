#include "koshi/directional.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace koshi::material {

std::optional<double> youngs_modulus(const ElasticTensor& C, const Vec3& direction) {
  const auto S = compliance(C);
  if (!S) return std::nullopt;
  const Vec3 n = (1 / std::sqrt(dot(direction, direction))) * direction;
  // Strain along n under a stress of n n.
  const std::array<double, 6> stress{n[0] * n[0], n[1] * n[1], n[2] * n[2], n[1] * n[2], n[0] * n[2], n[0] * n[1]};
  double strain = 0;
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j) strain += stress[i] * (*S)[i][j] * stress[j];
  return 1 / strain;
}

Vec3 wave_speeds(const ElasticTensor& C, double density, const Vec3& direction) {
  const Vec3 n = (1 / std::sqrt(dot(direction, direction))) * direction;
  // Christoffel: rho v^2 are the eigenvalues of C_ijkl n_j n_l.
  Eigen::Matrix3d acoustic = Eigen::Matrix3d::Zero();
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j < 3; ++j)
        for (int l = 0; l < 3; ++l) acoustic(i, k) += C(i, j, k, l) * n[j] * n[l];
  const Eigen::Vector3d squares =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(acoustic, Eigen::EigenvaluesOnly).eigenvalues();
  Vec3 speeds;
  for (int i = 0; i < 3; ++i) speeds[i] = std::sqrt(std::max(0.0, squares(2 - i)) / density);
  return speeds;
}

}  // namespace koshi::material
