#include "failure/softening.h"

namespace koshi::failure {

Softening::Softening(material::Softening kind, double youngs_modulus, double strength, double fracture_energy,
                     double width)
    : kind_(kind), youngs_modulus_(youngs_modulus) {
  const double g = fracture_energy / width;
  if (width >= width_limit(youngs_modulus, strength, fracture_energy)) {
    threshold_ = std::sqrt(2 * g / youngs_modulus);
    scale_ = 0;
    return;
  }
  threshold_ = strength / youngs_modulus;
  // Area under the stress-strain curve is g: a triangle, or the elastic triangle and the tail f_t scale.
  scale_ = kind == material::Softening::linear ? 2 * g / strength : g / strength - threshold_ / 2;
}

double Softening::damage(double kappa) const {
  if (kappa <= threshold_) return 0;
  if (scale_ == 0) return 1;
  if (kind_ == material::Softening::exponential)
    return 1 - threshold_ / kappa * std::exp(-(kappa - threshold_) / scale_);
  return kappa >= scale_ ? 1 : scale_ / (scale_ - threshold_) * (1 - threshold_ / kappa);
}

double Softening::dissipated(double kappa) const {
  if (kappa <= threshold_) return 0;
  const double strength = youngs_modulus_ * threshold_, elastic = 0.5 * strength * threshold_;
  if (scale_ == 0) return elastic;
  // Work of the stress, less the energy that is left.
  if (kind_ == material::Softening::exponential) {
    const double left = std::exp(-(kappa - threshold_) / scale_);
    return elastic + strength * scale_ * (1 - left) - 0.5 * strength * kappa * left;
  }
  if (kappa >= scale_) return 0.5 * strength * scale_;
  return 0.5 * strength * scale_ * (kappa - threshold_) / (scale_ - threshold_);
}

}  // namespace koshi::failure
