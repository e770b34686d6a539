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

double CellLaw::threshold_of(const Vec3& normal, double strength_factor) const {
  return threshold(youngs_modulus_, strength_factor * fracture_.tensile_strength, fracture_.fracture_energy,
                   band_width(d_, normal));
}

double CellLaw::safe(double strength_factor) const {
  // The widest band, across a body diagonal, breaks first.
  const double side = std::numbers::inv_sqrt3;
  return threshold_of({side, side, side}, strength_factor);
}

double CellLaw::equivalent(const Tensor6& strain) const {
  return criterion_.equivalent(principal(elastic_stress(lambda_, mu_, strain)).value) / youngs_modulus_;
}

Crack CellLaw::ahead(const Tensor6& strain, double strength_factor, const Vec3& lead) const {
  const Principal stress = principal(elastic_stress(lambda_, mu_, strain));
  Crack crack;
  crack.kappa = criterion_.equivalent(stress.value) / youngs_modulus_;
  crack.shear = criterion_.shears(stress.value);
  crack.normal = criterion_.normal(stress);
  if (!crack.shear && lead != Vec3{} && std::abs(dot(crack.normal, lead)) < std::numbers::sqrt2 / 2)
    crack.normal = lead;
  crack.limit = threshold_of(crack.normal, strength_factor);

  // The onset is at the same strain scaled to the limit.
  const double beyond = crack.kappa / crack.limit;
  crack.onset = energy(strain) / (beyond * beyond);
  // Cells that shear under pressure store much more than the crack of a tensile test takes; they soften by the same
  // law.
  const double stored = crack.shear ? 0.5 * youngs_modulus_ * crack.limit * crack.limit : crack.onset;
  crack.ratio = fracture_.fracture_energy / band_width(d_, crack.normal) / stored;
  return crack;
}

std::optional<Crack> CellLaw::onset(const Tensor6& strain, double strength_factor, const Vec3& lead) const {
  Crack crack = ahead(strain, strength_factor, lead);
  if (crack.kappa <= crack.limit) return std::nullopt;
  return crack;
}

Crack CellLaw::damaged(const Vec3& n, double damage, double strength_factor) const {
  Crack crack;
  crack.normal = n;
  crack.limit = threshold_of(n, strength_factor);
  crack.onset = 0.5 * youngs_modulus_ * crack.limit * crack.limit;
  crack.ratio = fracture_.fracture_energy / band_width(d_, n) / crack.onset;
  if (damage >= 1 || crack.ratio <= 1) {
    crack.damage = 1;
    crack.taken = crack.ratio;
    crack.kappa = std::max(crack.ratio, 1.0) * crack.limit;
    return crack;
  }
  // The strength that is left is (1 - damage) times the elastic stress: less of it at a larger strain.
  const Softening law(fracture_.softening, crack.ratio);
  double low = 0, high = 1;
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = 0.5 * (low + high);
    (middle < (1 - damage) * law.strain(middle) ? low : high) = middle;
  }
  crack.damage = damage;
  crack.taken = law.taken(high);
  crack.kappa = law.strain(high) * crack.limit;
  return crack;
}

void CellLaw::soften(Crack& crack, const Tensor6& strain, double energy) const {
  const Principal stress = principal(elastic_stress(lambda_, mu_, strain));
  const double kappa = criterion_.equivalent(stress.value) / youngs_modulus_;
  if (kappa < crack.kappa) return;
  crack.kappa = kappa;
  const double before = crack.damage;
  const Softening law(fracture_.softening, crack.ratio);
  crack.damage = law.damage(before, crack.taken, kappa / crack.limit, energy / crack.onset);
  crack.taken += (crack.damage - before) * energy / crack.onset;
}

double CellLaw::slide_faces(Crack& crack, const Tensor6& strain) const {
  const Vec3 before = crack.slip;
  crack.slip = slide({youngs_modulus_, mu_}, friction_, crack.normal, before, strain);
  return dot(faces(crack, strain).shear, crack.slip - before);
}

}  // namespace koshi::failure
