// Principal values and directions of a symmetric tensor.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "koshi/vector3.h"
#include "mechanics/cell_stress.h"

namespace koshi::failure {

using mechanics::Tensor6;

struct Principal {
  Vec3 value;                     ///< descending
  std::array<Vec3, 3> direction;  ///< unit vectors, orthogonal; of two opposite ones that whose last non-zero
                                  ///< component is positive
};

/// Of a tensor in the order xx, yy, zz, yz, xz, xy. Accurate to rounding of its largest value.
Principal principal(const Tensor6& tensor);

/// n . t . n.
inline double along(const Tensor6& t, const Vec3& n) {
  return t[0] * n[0] * n[0] + t[1] * n[1] * n[1] + t[2] * n[2] * n[2] +
         2 * (t[3] * n[1] * n[2] + t[4] * n[0] * n[2] + t[5] * n[0] * n[1]);
}

/// t . n.
inline Vec3 times(const Tensor6& t, const Vec3& n) {
  return {t[0] * n[0] + t[5] * n[1] + t[4] * n[2], t[5] * n[0] + t[1] * n[1] + t[3] * n[2],
          t[4] * n[0] + t[3] * n[1] + t[2] * n[2]};
}

/// t : t.
inline double square(const Tensor6& t) {
  return t[0] * t[0] + t[1] * t[1] + t[2] * t[2] + 2 * (t[3] * t[3] + t[4] * t[4] + t[5] * t[5]);
}

/// Mean p and radius r of the deviator: the principal values are p + r cos(angle), the angles 120 degrees apart.
struct MeanRadius {
  double mean, radius;
};
inline MeanRadius mean_radius(const Tensor6& t) {
  const double p = (t[0] + t[1] + t[2]) / 3;
  return {p, std::sqrt(std::max(2.0 / 3 * (square(t) - 3 * p * p), 0.0))};
}

/// Isotropic elastic stress lambda tr(strain) I + 2 mu strain [Pa].
inline Tensor6 elastic_stress(double lambda, double mu, const Tensor6& strain) {
  const double pressure = lambda * (strain[0] + strain[1] + strain[2]);
  Tensor6 stress;
  for (std::size_t v = 0; v < 6; ++v) stress[v] = 2 * mu * strain[v] + (v < 3 ? pressure : 0);
  return stress;
}

/// Energy of the same [J/m^3].
inline double elastic_energy(double lambda, double mu, const Tensor6& strain) {
  const double trace = strain[0] + strain[1] + strain[2];
  return 0.5 * lambda * trace * trace + mu * square(strain);
}

}  // namespace koshi::failure
