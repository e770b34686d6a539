#include "model/plane_cut.h"

#include <algorithm>

namespace koshi::model {

double part_below(const Vec3& normal, double offset) {
  // The components by size, their sum 1; the plane's distance from the lowest corner in the same unit.
  Vec3 m{std::abs(normal[0]), std::abs(normal[1]), std::abs(normal[2])};
  std::sort(m.begin(), m.end());
  const double sum = m[0] + m[1] + m[2];
  double alpha = offset / sum + 0.5;
  if (alpha <= 0) return 0;
  if (alpha >= 1) return 1;
  m = (1 / sum) * m;
  // The formulas divide by the smallest component and lose digits when it is tiny; without it they are those of a
  // square.
  if (m[0] < 1e-8) m[0] = 0;

  // The cube is the same seen from the other corner.
  const bool upper = alpha > 0.5;
  if (upper) alpha = 1 - alpha;
  const auto cube = [](double x) { return x * x * x; };
  const double pair = m[0] + m[1], six = 6 * m[0] * m[1] * m[2];
  double part = 0;
  if (alpha < m[0])
    part = cube(alpha) / six;
  else if (alpha < m[1])
    part = alpha * (alpha - m[0]) / (2 * m[1] * m[2]) + m[0] * m[0] / (6 * m[1] * m[2]);
  else if (alpha >= pair && pair <= m[2])
    part = (2 * alpha - pair) / (2 * m[2]);
  else
    part = (cube(alpha) - cube(alpha - m[0]) - cube(alpha - m[1]) - (alpha > m[2] ? cube(alpha - m[2]) : 0)) / six;
  return upper ? 1 - part : part;
}

double offset_of_part(const Vec3& normal, double part) {
  const double most = 0.5 * (std::abs(normal[0]) + std::abs(normal[1]) + std::abs(normal[2]));
  double low = -most, high = most;
  // The part grows with the offset; halving ends at neighbouring numbers.
  for (int step = 0; step < 60; ++step) {
    const double middle = 0.5 * (low + high);
    (part_below(normal, middle) < part ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace koshi::model
