// Polygons cut along the planes between cells.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "koshi/vector3.h"

namespace koshi::model {

/// Corners of a flat convex polygon in order; places counted in cells, cell i from i to i + 1.
using Polygon = std::vector<Vec3>;

/// Twice the area times the normal, counter-clockwise seen from its tip.
inline Vec3 double_area(const Polygon& polygon) {
  Vec3 sum{};
  for (std::size_t v = 2; v < polygon.size(); ++v)
    sum = sum + cross(polygon[v - 1] - polygon[0], polygon[v] - polygon[0]);
  return sum;
}

/// Two directions across a third, all of length 1 and right-handed.
inline std::array<Vec3, 2> across(const Vec3& direction) {
  std::size_t least = 0;
  for (std::size_t a = 1; a < 3; ++a)
    if (std::abs(direction[a]) < std::abs(direction[least])) least = a;
  Vec3 axis{};
  axis[least] = 1;
  Vec3 u = cross(direction, axis);
  u = (1 / norm(u)) * u;
  return {u, cross(direction, u)};
}

/// The parts of a polygon with x[axis] below and above a plane.
inline std::pair<Polygon, Polygon> split(const Polygon& polygon, std::size_t axis, double plane) {
  std::pair<Polygon, Polygon> parts;
  for (std::size_t v = 0; v < polygon.size(); ++v) {
    const Vec3 &a = polygon[v], &b = polygon[(v + 1) % polygon.size()];
    if (a[axis] <= plane) parts.first.push_back(a);
    if (a[axis] >= plane) parts.second.push_back(a);
    if ((a[axis] < plane) == (b[axis] < plane) || a[axis] == plane || b[axis] == plane) continue;
    // The ends in one order always: the same point for both polygons at an edge.
    const bool up = a[axis] < b[axis];
    const Vec3 &low = up ? a : b, &high = up ? b : a;
    Vec3 at = low + ((plane - low[axis]) / (high[axis] - low[axis])) * (high - low);
    at[axis] = plane;
    parts.first.push_back(at);
    parts.second.push_back(at);
  }
  return parts;
}

/// Calls f(cell, polygon) for the parts of a polygon in the cells from `first` to before `end`, starting with `axis`
/// (0: all three). A part on the plane between two cells goes to the upper one, on the last plane to the last cell.
template <class F>
void for_each_part(Polygon rest, std::size_t axis, const Int3& first, const Int3& end, Int3 cell, F&& f) {
  if (axis == 3) {
    f(cell, rest);
    return;
  }
  double low = rest[0][axis], high = low;
  for (const Vec3& x : rest) {
    low = std::min(low, x[axis]);
    high = std::max(high, x[axis]);
  }
  const auto last = static_cast<double>(end[axis] - 1);
  double i = std::max(std::floor(low), static_cast<double>(first[axis]));
  if (low == high && low == last + 1) i = last;
  if (low < i) rest = split(rest, axis, i).second;
  for (; i <= last && i <= high && rest.size() >= 3; ++i) {
    cell[axis] = static_cast<std::int64_t>(i);
    if (high <= i + 1) {
      for_each_part(std::move(rest), axis + 1, first, end, cell, f);
      return;
    }
    auto [below, above] = split(rest, axis, i + 1);
    if (below.size() >= 3) for_each_part(std::move(below), axis + 1, first, end, cell, f);
    rest = std::move(above);
  }
}

}  // namespace koshi::model
