#include <Eigen/Dense>

#include "koshi/calibration.h"

namespace koshi::material {
namespace {

/// Row of the 6 x 6 matrix that holds the pair ij.
constexpr std::array<std::array<int, 3>, 3> voigt_index{{{0, 5, 4}, {5, 1, 3}, {4, 3, 2}}};

/// The pair ij of each row.
constexpr std::array<std::array<int, 2>, 6> voigt_pair{{{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}};

constexpr double delta(int i, int j) { return i == j ? 1 : 0; }

}  // namespace

double ElasticTensor::operator()(int i, int j, int k, int l) const {
  return voigt[voigt_index[i][j]][voigt_index[k][l]];
}

ElasticTensor elastic_tensor(const Elastic& elastic) {
  ElasticTensor C;
  for (int row = 0; row < 6; ++row)
    for (int column = 0; column < 6; ++column) {
      const auto [i, j] = voigt_pair[row];
      const auto [k, l] = voigt_pair[column];
      C.voigt[row][column] = elastic.lambda() * delta(i, j) * delta(k, l) +
                             elastic.mu() * (delta(i, k) * delta(j, l) + delta(i, l) * delta(j, k));
    }
  return C;
}

ElasticTensor lattice_tensor(std::span<const BondGroup> bonds, double volume, double kappa) {
  ElasticTensor C;
  for (int row = 0; row < 6; ++row)
    for (int column = 0; column < 6; ++column) {
      const auto [i, j] = voigt_pair[row];
      const auto [k, l] = voigt_pair[column];
      double sum = 0;
      for (const BondGroup& bond : bonds) {
        // (N21), with d_m^2 I_j I_k = D_j D_k.
        const Vec3& D = bond.D;
        const double shear = (D[j] * D[k] * delta(i, l) + D[i] * D[k] * delta(j, l) + D[j] * D[l] * delta(i, k) +
                              D[i] * D[l] * delta(j, k)) /
                             4;
        const double normal = D[i] * D[j] * D[k] * D[l] / dot(D, D);
        sum += bond.count * (bond.kt * shear + (bond.kn - bond.kt) * normal);
      }
      C.voigt[row][column] = sum / volume + kappa * delta(i, j) * delta(k, l);
    }
  return C;
}

std::optional<std::array<std::array<double, 6>, 6>> compliance(const ElasticTensor& C) {
  using Matrix6 = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;
  const Eigen::FullPivLU<Eigen::Matrix<double, 6, 6>> lu(Eigen::Map<const Matrix6>(C.voigt[0].data()));
  if (!lu.isInvertible()) return std::nullopt;
  std::array<std::array<double, 6>, 6> S;
  Eigen::Map<Matrix6>(S[0].data()) = lu.inverse();
  return S;
}

std::optional<EngineeringConstants> engineering_constants(const ElasticTensor& C) {
  const auto inverse = compliance(C);
  if (!inverse) return std::nullopt;
  const auto& S = *inverse;

  EngineeringConstants constants;
  for (int i = 0; i < 3; ++i) {
    constants.youngs_modulus[i] = 1 / S[i][i];
    constants.shear_modulus[i] = 1 / S[3 + i][3 + i];
    for (int j = 0; j < 3; ++j) constants.poissons_ratio[i][j] = i == j ? 0 : -S[j][i] / S[i][i];
  }
  const double C1111 = C.voigt[0][0] + C.voigt[1][1] + C.voigt[2][2];
  const double C1122 = C.voigt[0][1] + C.voigt[1][2] + C.voigt[0][2];
  const double C1212 = C.voigt[3][3] + C.voigt[4][4] + C.voigt[5][5];
  constants.zener_ratio = 2 * C1212 / (C1111 - C1122);
  return constants;
}

}  // namespace koshi::material
