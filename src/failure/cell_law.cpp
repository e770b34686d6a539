#include "failure/cell_law.h"

#include <algorithm>
#include <numbers>

namespace koshi::failure {

CellLaw::CellLaw(const material::Elastic& elastic, const material::Fracture& fracture, double d)
    : youngs_modulus_(elastic.youngs_modulus),
      lambda_(elastic.lambda()),
      mu_(elastic.mu()),
      fracture_(fracture),
      criterion_(fracture),
      friction_(std::tan(fracture.residual_friction_angle)),
      d_(d) {}

Softening CellLaw::softening(const Vec3& normal, double strength_factor) const {
  return {fracture_.softening, youngs_modulus_, strength_factor * fracture_.tensile_strength, fracture_.fracture_energy,
          band_width(d_, normal)};
}

double CellLaw::safe(double strength_factor) const {
  // The widest band, across a body diagonal, breaks first.
  const double side = std::numbers::inv_sqrt3;
  return softening({side, side, side}, strength_factor).threshold();
}

std::optional<Crack> CellLaw::onset(const Tensor6& strain, double strength_factor) const {
  const Principal stress = principal(elastic_stress(lambda_, mu_, strain));
  const double kappa = criterion_.equivalent(stress.value) / youngs_modulus_;
  const Vec3 normal = criterion_.normal(stress);
  const Softening law = softening(normal, strength_factor);
  if (kappa <= law.threshold()) return std::nullopt;
  Crack crack;
  crack.normal = normal;
  crack.strength = strength_factor;
  crack.kappa = kappa;
  crack.damage = law.damage(kappa);
  return crack;
}

void CellLaw::soften(Crack& crack, const Tensor6& strain) const {
  if (bound(strain) <= crack.kappa) return;
  const Principal stress = principal(elastic_stress(lambda_, mu_, strain));
  const double kappa = criterion_.equivalent(stress.value) / youngs_modulus_;
  if (kappa <= crack.kappa) return;
  crack.kappa = kappa;
  crack.damage = softening(crack.normal, crack.strength).damage(kappa);
}

double CellLaw::slide_faces(Crack& crack, const Tensor6& strain) const {
  const Vec3 before = crack.slip;
  crack.slip = slide({youngs_modulus_, mu_}, friction_, crack.normal, before, strain);
  return dot(faces(crack, strain).shear, crack.slip - before);
}

}  // namespace koshi::failure
