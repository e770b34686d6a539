// Points of a triangle at which a polynomial of the fourth degree has its integral.
#pragma once

#include <array>
#include <cmath>

#include "koshi/vector3.h"

namespace koshi::model {

/// Calls f(place, share) at six points of a triangle; shares of the area, sum 1. Exact to the fourth degree
/// (D. A. Dunavant, doi:10.1002/nme.1620210612; the closed form of its digits).
template <class F>
void for_each_point(const Vec3& a, const Vec3& b, const Vec3& c, F&& f) {
  struct Points {
    double other, share;  // weight of the two corners that are not a point's own
  };
  static const std::array<Points, 2> points = [] {
    const double ten = std::sqrt(10.0), root = std::sqrt(38 - 44 * std::sqrt(0.4));
    const double from = std::sqrt(213125 - 53320 * ten);
    return std::array<Points, 2>{
        {{(8 - ten + root) / 18, (620 + from) / 3720}, {(8 - ten - root) / 18, (620 - from) / 3720}}};
  }();
  const Vec3 all = a + b + c;
  for (const Points& p : points)
    for (const Vec3& own : {a, b, c}) f(p.other * all + (1 - 3 * p.other) * own, p.share);
}

}  // namespace koshi::model
