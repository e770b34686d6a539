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

}  // namespace koshi::homogenize
