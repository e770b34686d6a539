#include "material/mixture.h"

#include <algorithm>
#include <cmath>

namespace koshi::material {
namespace {

struct Moduli {
  double bulk = 0;
  double shear = 0;
};

Moduli moduli_of(const Elastic& solid) { return {solid.lambda() + 2 * solid.mu() / 3, solid.mu()}; }

Elastic solid_of(const Moduli& m, double density) {
  return {9 * m.bulk * m.shear / (3 * m.bulk + m.shear), (3 * m.bulk - 2 * m.shear) / (2 * (3 * m.bulk + m.shear)),
          density};
}

double p_wave(const Moduli& m) { return m.bulk + 4 * m.shear / 3; }

double square(double x) { return x * x; }

}  // namespace

Elastic mixture(const Elastic& first, const Elastic& second, double share, const Elastic& inclusion) {
  const Moduli a = moduli_of(first), b = moduli_of(second), i = moduli_of(inclusion);
  const auto mean = [&](auto&& f) { return (1 - share) * f(a) + share * f(b); };
  // The right sides of (14.8) and (14.9).
  const double even =
      mean([&](const Moduli& x) { return 6 * x.shear - 8 * square(x.shear + 0.75 * i.bulk) / p_wave(x); });
  const double uneven = mean([&](const Moduli& x) {
    return 9 * x.shear - 4 * square(x.shear - i.shear) / p_wave(x) - 6 * square(i.shear) / x.shear;
  });

  // The first gives 1/M of any G, the second then the G, which lies between those of the two. Fifty-five halvings leave
  // no digit open, and the bits are the same everywhere.
  const auto inverse_p_wave = [&](double G) { return (6 * G - even) / (8 * square(G + 0.75 * i.bulk)); };
  double low = std::min(a.shear, b.shear), high = std::max(a.shear, b.shear);
  for (int step = 0; step < 55; ++step) {
    const double G = (low + high) / 2;
    const double left = 9 * G - 4 * square(G - i.shear) * inverse_p_wave(G) - 6 * square(i.shear) / G;
    (left < uneven ? low : high) = G;
  }
  double G = (low + high) / 2, K = 1 / inverse_p_wave(G) - 4 * G / 3;
  // The fields of a ball are a guess: at great contrast they can ask for a little less than the softest mixture has, or
  // more than the stiffest.
  const auto within = [&](double value, double Moduli::*of) {
    return std::clamp(value, 1 / mean([&](const Moduli& x) { return 1 / (x.*of); }),
                      mean([&](const Moduli& x) { return x.*of; }));
  };
  G = within(G, &Moduli::shear);
  K = within(K, &Moduli::bulk);
  return solid_of({K, G}, (1 - share) * first.density + share * second.density);
}

Elastic geometric_mean(const Elastic& first, const Elastic& second, double part) {
  const Moduli a = moduli_of(first), b = moduli_of(second);
  const auto between = [&](double x, double y) { return std::pow(x, 1 - part) * std::pow(y, part); };
  return solid_of({between(a.bulk, b.bulk), between(a.shear, b.shear)}, between(first.density, second.density));
}

}  // namespace koshi::material
