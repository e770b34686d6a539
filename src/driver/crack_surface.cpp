#include "driver/crack_surface.h"

#include <algorithm>
#include <cmath>

namespace koshi::driver {
namespace {

// What of a polygon lies on the side of the plane x[axis] = border where sign x[axis] is less (Sutherland, Hodgman);
// corners within the slack lie on it.
std::vector<Vec3> clipped(const std::vector<Vec3>& polygon, std::size_t axis, double sign, double border,
                          double slack) {
  std::vector<Vec3> inside;
  for (std::size_t p = 0; p < polygon.size(); ++p) {
    const Vec3 &a = polygon[p], &b = polygon[(p + 1) % polygon.size()];
    const double over_a = sign * (a[axis] - border), over_b = sign * (b[axis] - border);
    if (over_a <= slack) inside.push_back(a);
    if ((over_a < -slack && over_b > slack) || (over_a > slack && over_b < -slack))
      inside.push_back(a + (over_a / (over_a - over_b)) * (b - a));
  }
  return inside;
}

}  // namespace

std::vector<Vec3> cut_of_cell(const Vec3& centre, double d, const Vec3& n) {
  // A square in the plane that is larger than any cut, cut by the six faces; the axis farthest from the normal gives a
  // direction along the plane.
  Vec3 axis{};
  axis[static_cast<std::size_t>(
      std::min_element(n.begin(), n.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }) - n.begin())] =
      1;
  const Vec3 across = cross(n, axis), e = (d / norm(across)) * across, f = cross(n, e);
  std::vector<Vec3> polygon{e + f, f - e, Vec3{} - e - f, e - f};
  const double slack = 1e-9 * d;
  for (std::size_t a = 0; a < 3; ++a)
    for (const double sign : {-1.0, 1.0}) polygon = clipped(polygon, a, sign, sign * 0.5 * d, slack);
  // Where the plane meets a corner of the cell, two corners may be left for one.
  std::vector<Vec3> corners;
  for (std::size_t p = 0; p < polygon.size(); ++p)
    if (norm(polygon[(p + 1) % polygon.size()] - polygon[p]) > slack) corners.push_back(polygon[p] + centre);
  return corners;
}

std::vector<std::vector<Vec3>> crack_surface(const lattice::Grid& grid, std::span<const CrackedCell> cells) {
  std::vector<std::vector<Vec3>> polygons;
  polygons.reserve(cells.size());
  for (const CrackedCell& cell : cells) {
    const Vec3 corner = grid.position(cell_indices(grid, cell.number));
    polygons.push_back(cut_of_cell(corner + 0.5 * grid.d * Vec3{1, 1, 1}, grid.d, cell.normal));
  }
  return polygons;
}

}  // namespace koshi::driver
