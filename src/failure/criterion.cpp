#include "failure/criterion.h"

#include <algorithm>
#include <numbers>

namespace koshi::failure {

Criterion::Criterion(const material::Fracture& fracture) {
  if (!fracture.cohesion) return;
  ratio_ = fracture.tensile_strength / fracture.compressive_strength();
  m_ = fracture.confinement_factor();
  spread_ = std::sqrt(m_ * m_ + m_ + 1);
  const double angle = std::numbers::pi / 4 + fracture.friction_angle / 2;
  shear_ = {std::sin(angle), 0, std::cos(angle)};
}

Vec3 Criterion::normal(const Principal& stress) const {
  const double tension = stress.value[0], shear = ratio_ * (m_ * stress.value[0] - stress.value[2]);
  if (tension >= shear) return stress.direction[0];
  return shear_[0] * stress.direction[0] + shear_[2] * stress.direction[2];
}

double Criterion::bound(const Tensor6& stress) const {
  // With the mean stress p and the radius r of the deviator, principal stresses are p + r cos(angle), the angles 120
  // degrees apart: s1 <= p + r, and m s1 - s3 is (m - 1) p plus a cosine of amplitude r sqrt(m^2 + m + 1).
  const double p = (stress[0] + stress[1] + stress[2]) / 3;
  const double deviator = square(stress) - 3 * p * p;
  const double r = std::sqrt(2.0 / 3 * std::max(deviator, 0.0));
  return std::max(p + r, ratio_ * ((m_ - 1) * p + spread_ * r));
}

}  // namespace koshi::failure
