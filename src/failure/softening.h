// How a cell loses its stiffness as it is strained beyond its strength, so that a band of cells takes the fracture
// energy for each area of crack (theory, section 12).
#pragma once

#include <cmath>

#include "koshi/fracture.h"
#include "koshi/vector3.h"

namespace koshi::failure {

/// Volume of the cells that a plane of unit normal n cuts, over its area [m]: d (|n1| + |n2| + |n3|).
inline double band_width(double d, const Vec3& n) { return d * (std::abs(n[0]) + std::abs(n[1]) + std::abs(n[2])); }

/// Largest band width [m] with which a cell can have both the strength f_t [Pa] and the fracture energy G_f [J/m^2]:
/// the elastic energy f_t^2/(2E) of its volume must not be more than the crack takes.
inline double width_limit(double youngs_modulus, double strength, double fracture_energy) {
  return 2 * youngs_modulus * fracture_energy / (strength * strength);
}

/// Damage 0 <= omega <= 1 of a cell by the largest equivalent strain kappa = (equivalent stress)/E it has seen. Stress
/// is (1 - omega) times the elastic one.
class Softening {
 public:
  /// E [Pa], f_t [Pa], G_f [J/m^2], width h of the crack band [m]; all > 0. A band wider than width_limit() keeps G_f
  /// and breaks at once at the lower strength sqrt(2 E G_f/h).
  Softening(material::Softening kind, double youngs_modulus, double strength, double fracture_energy, double width);

  /// Damage at kappa; 0 up to threshold().
  double damage(double kappa) const;
  /// Energy [J/m^3] that uniaxial tension up to kappa has taken for good; G_f/h in the end.
  double dissipated(double kappa) const;
  /// kappa at which damage starts.
  double threshold() const { return threshold_; }

 private:
  material::Softening kind_;
  double youngs_modulus_;
  double threshold_;  // e0
  double scale_;      // linear: kappa at which nothing is left; exponential: decay of the stress with kappa; 0: at once
};

}  // namespace koshi::failure
