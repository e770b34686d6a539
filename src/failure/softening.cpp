#include "failure/softening.h"

#include <limits>

namespace koshi::failure {

// Uniaxial tension by x times the strain of the onset, elastic energy x^2: where the stress falls as s(x), the crack
// has taken the area under s less the triangle s x/2, twice, since areas are in units of twice the energy. On the line
// from s(1) = 1 to s(ratio) = 0 that is ratio (1 - s); for s = exp(-(x - 1)/b), 2b = ratio - 1, it is 1 + 2b (1 - s) -
// s x.
double Softening::taken(double strength) const {
  if (kind_ == material::Softening::linear) return ratio_ * (1 - strength);
  if (strength <= 0) return ratio_;
  return ratio_ - strength * (ratio_ - 0.5 * (ratio_ - 1) * std::log(strength));
}

double Softening::strain(double strength) const {
  return kind_ == material::Softening::linear ? ratio_ - (ratio_ - 1) * strength
                                              : 1 - 0.5 * (ratio_ - 1) * std::log(strength);
}

double Softening::damage(double damage, double before, double stress, double energy) const {
  if (ratio_ <= 1) return stress > 1 ? 1 : damage;
  // What is missing to the energy at which the strength would be `strength`, if damage brought the stress down to that.
  const auto missing = [&](double strength) {
    return taken(strength) - before - energy * (1 - strength / stress - damage);
  };
  double high = (1 - damage) * stress, low = 0;
  const double strongest = std::min(high, 1.0);
  if (high <= 1 && missing(high) >= 0) return damage;
  // More energy than is left for the crack: it runs through the cell at once.
  if (missing(0) <= 0) return 1;
  // The strength lies between 0, where energy is missing, and where there is too much of it.
  high = strongest;
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = 0.5 * (low + high);
    (missing(middle) > 0 ? low : high) = middle;
  }
  return std::max(damage, 1 - low / stress);
}

double Softening::reach(double before, double gain, double stress) const {
  constexpr double never = std::numeric_limits<double>::infinity();
  if (stress <= 0) return gain > 0 ? std::max(ratio_ - before, 0.0) / gain : never;
  if (ratio_ <= 1) return 1 / stress;
  // The less strength is left, the more has been taken; at a higher factor more of it is missing.
  double low = 0, high = 1;
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = 0.5 * (low + high);
    (taken(middle) > before + gain * middle / stress ? low : high) = middle;
  }
  return high / stress;
}

}  // namespace koshi::failure
