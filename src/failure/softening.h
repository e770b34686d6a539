// How a cell loses its stiffness as it is strained beyond its strength, so that a band of cells takes the fracture
// energy for each area of crack (theory, section 12).
#pragma once

#include <algorithm>
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

/// Equivalent strain at which a cell cracks: f_t/E; sqrt(2 G_f/(E h)) in a band of width h [m] beyond width_limit().
inline double threshold(double youngs_modulus, double strength, double fracture_energy, double width) {
  return std::min(strength / youngs_modulus, std::sqrt(2 * fracture_energy / (youngs_modulus * width)));
}

/// Strength of a cell by the energy its crack has taken. Stresses are over the strength at the onset, energies over the
/// elastic energy at the onset.
class Softening {
 public:
  /// `ratio`, > 0: the energy that the crack takes in all; up to 1 the cell breaks at once.
  Softening(material::Softening kind, double ratio) : kind_(kind), ratio_(ratio) {}

  /// Energy taken when the strength has fallen to 0 <= strength <= 1: from 0 to ratio.
  double taken(double strength) const;

  /// Strain of uniaxial tension, over that of the onset, at which `strength` is left, 0 < strength <= 1.
  double strain(double strength) const;

  /// Damage of a cell that had `damage` and whose crack had taken `taken`, when the elastic stress grows to `stress`,
  /// and damage takes `energy` for each unit: the least, not below `damage`, at which (1 - damage) stress is no more
  /// than the strength that is left.
  double damage(double damage, double taken, double stress, double energy) const;

  /// The factor at which the stress of a cell that carries `stress` times it meets the strength that is left, where the
  /// crack has `taken` and takes `gain` >= 0 more for each unit of the factor; infinite where it never does. A cell
  /// that carries nothing meets it when the crack has taken all.
  double reach(double taken, double gain, double stress) const;

 private:
  material::Softening kind_;
  double ratio_;
};

}  // namespace koshi::failure
