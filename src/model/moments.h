// Moments of the part of a cell that lies inside a body.
#pragma once

#include "koshi/spring_lattice.h"
#include "koshi/vector3.h"

namespace koshi::model {

/// Exponents (a, b, c) of a moment.
struct Powers {
  int x, y, z;
};

/// Those of the moments, in their order: all sums of two of (0, 0, 0), (1, 0, 0) ... (1, 1, 0), which are the degrees
/// that the strain of a trilinear displacement has.
inline constexpr std::array<Powers, moment_count> moment_powers{
    {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 1, 1}, {1, 0, 1}, {1, 1, 0}, {2, 0, 0},
     {0, 2, 0}, {0, 0, 2}, {1, 1, 1}, {2, 1, 0}, {2, 0, 1}, {1, 2, 0}, {0, 2, 1}, {1, 0, 2},
     {0, 1, 2}, {0, 2, 2}, {2, 0, 2}, {2, 2, 0}, {2, 1, 1}, {1, 2, 1}, {1, 1, 2}}};

/// Place of a moment in that order; -1: there is none.
constexpr int moment_index(const Powers& p) {
  for (int m = 0; m < moment_count; ++m) {
    const Powers& q = moment_powers[static_cast<std::size_t>(m)];
    if (p.x == q.x && p.y == q.y && p.z == q.z) return m;
  }
  return -1;
}

/// A cube in a cell, its centre and half its edge in half edges of the cell, from the cell's centre.
struct PartCube {
  Vec3 centre{};
  double half = 1;
};

/// What a cube adds to the moments of its cell.
Moments moments_of_cube(const PartCube& cube);

/// The same of the part of a cube where normal . (x - centre) <= offset; the normal need not have length 1, but not 0.
/// Exact to rounding.
Moments moments_below(const PartCube& cube, const Vec3& normal, double offset);

}  // namespace koshi::model
