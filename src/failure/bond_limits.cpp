#include "failure/bond_limits.h"

#include <cmath>

namespace koshi::failure {

// A plane across x cuts |s_x| bonds of a slot on d^2. One that opens by delta along x stretches them by delta s_x/(d
// |s|^2) and shears them by sqrt(|s|^2 - 1) times as much, s_x^2 = 1: broken at the stretch e each has taken (kn + kt
// (|s|^2 - 1)) (e |s| d)^2/2.
double critical_stretch(const material::Springs& springs, double fracture_energy) {
  double sum = 0;
  for (const lattice::Slot& slot : lattice::slots) {
    const double square = lattice::squared_length[slot.family];
    if (slot.s[0] != 0) sum += square * (springs.kn[slot.family] + (square - 1) * springs.kt[slot.family]);
  }
  return std::sqrt(2 * fracture_energy / sum);
}

BondLimits bond_limits(const material::Fracture& fracture, const material::Springs& springs) {
  BondLimits limits;
  limits.stretch =
      fracture.critical_stretch ? *fracture.critical_stretch : critical_stretch(springs, fracture.fracture_energy);
  if (fracture.critical_shear) limits.shear = *fracture.critical_shear;
  return limits;
}

}  // namespace koshi::failure
