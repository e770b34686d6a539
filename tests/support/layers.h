// The exact stiffness of layered bodies.
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "koshi/calibration.h"

namespace koshi::test {

/// Backus 1962, J. Geophys. Res. 67: layers across `axis` with the given materials in equal shares.
inline material::ElasticTensor backus(int axis, const std::vector<material::Elastic>& layers) {
  const auto mean = [&](auto&& f) {
    double sum = 0;
    for (const material::Elastic& e : layers) sum += f(e.lambda(), e.mu(), e.lambda() + 2 * e.mu());
    return sum / static_cast<double>(layers.size());
  };
  const double C = 1 / mean([](double, double, double p) { return 1 / p; });
  const double ratio = mean([](double l, double, double p) { return l / p; });
  const double F = C * ratio;
  const double L = 1 / mean([](double, double m, double) { return 1 / m; });
  const double M = mean([](double, double m, double) { return m; });
  const double A = mean([](double l, double m, double p) { return 4 * m * (l + m) / p; }) + C * ratio * ratio;
  material::ElasticTensor T;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) T.voigt[i][j] = i == j ? (i == axis ? C : A) : (i == axis || j == axis ? F : A - 2 * M);
    T.voigt[3 + i][3 + i] = i == axis ? M : L;  // row 3 + i is the shear across the plane without axis i
  }
  return T;
}

/// Every entry, as a part of the first one. Returns how many.
inline int compare(const material::ElasticTensor& found, const material::ElasticTensor& expected, double tolerance) {
  const double scale = expected.voigt[0][0];
  int compared = 0;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j, ++compared)
      EXPECT_NEAR(found.voigt[i][j] / scale, expected.voigt[i][j] / scale, tolerance) << i << ' ' << j;
  return compared;
}

}  // namespace koshi::test
