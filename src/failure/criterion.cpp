#include "failure/criterion.h"

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
  if (!shears(stress.value)) return stress.direction[0];
  return shear_[0] * stress.direction[0] + shear_[2] * stress.direction[2];
}

}  // namespace koshi::failure
