// When a bond breaks: how far it may stretch and shear. Knows no lattice, no rank, no solver (theory, section 12,
// "Bonds that break").
#pragma once

#include <limits>

#include "koshi/fracture.h"
#include "koshi/springs.h"

namespace koshi::failure {

/// What bonds stand, over their length: of the relative displacement r (N23), r.D/|D| and the rest.
struct BondLimits {
  double stretch = std::numeric_limits<double>::infinity();
  double shear = std::numeric_limits<double>::infinity();
};

/// How a bond breaks.
enum class Break { none, by_stretch, by_shear };

/// Whether a bond with these limits stands a stretch (negative: shortened) and a shear >= 0. Where both are reached the
/// stretch counts.
inline Break broken(const BondLimits& limits, double stretch, double shear) {
  if (stretch >= limits.stretch) return Break::by_stretch;
  return shear >= limits.shear ? Break::by_shear : Break::none;
}

/// The critical stretch with which a plane along the cells takes G_f [J/m^2] as it opens: the energy that the bonds it
/// cuts hold when they break, in stretch and in shear.
double critical_stretch(const material::Springs& springs, double fracture_energy);

/// Limits of a material with these springs.
BondLimits bond_limits(const material::Fracture& fracture, const material::Springs& springs);

}  // namespace koshi::failure
