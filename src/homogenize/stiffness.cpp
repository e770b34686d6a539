#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "koshi/homogenize.h"

namespace koshi::homogenize {

ClosestIsotropic closest_isotropic(const material::ElasticTensor& C) {
  // Projections on the two isotropic parts: 9 K = C_iijj, and 10 G = C_ijij - C_iijj / 3.
  const auto& V = C.voigt;
  double trace = 0, diagonal = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) trace += V[i][j];
    diagonal += V[i][i] + 2 * V[3 + i][3 + i];
  }
  ClosestIsotropic closest;
  closest.moduli = {trace / 9, (diagonal - trace / 3) / 10};
  const double K = closest.moduli.bulk, G = closest.moduli.shear;
  double difference = 0, size = 0;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) {
      const double isotropic = i < 3 && j < 3 ? K - 2 * G / 3 + (i == j ? 2 * G : 0) : (i == j ? G : 0);
      // An entry of the matrix stands for one, two or four of the tensor.
      const double count = (i < 3 ? 1 : 2) * (j < 3 ? 1 : 2);
      difference += count * std::pow(V[i][j] - isotropic, 2);
      size += count * V[i][j] * V[i][j];
    }
  closest.distance = size > 0 ? std::sqrt(difference / size) : 0;
  return closest;
}

std::optional<double> youngs_modulus(const material::ElasticTensor& C, const Vec3& direction) {
  const auto S = material::compliance(C);
  if (!S) return std::nullopt;
  const Vec3 n = (1 / std::sqrt(dot(direction, direction))) * direction;
  // Strain along n under a stress of n n.
  const std::array<double, 6> stress{n[0] * n[0], n[1] * n[1], n[2] * n[2], n[1] * n[2], n[0] * n[2], n[0] * n[1]};
  double strain = 0;
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j) strain += stress[i] * (*S)[i][j] * stress[j];
  return 1 / strain;
}

Vec3 wave_speeds(const material::ElasticTensor& C, double density, const Vec3& direction) {
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

}  // namespace koshi::homogenize
