#include "io/surface_cut.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/closure.h"
#include "io/stl.h"
#include "koshi/error.h"
#include "model/clip.h"
#include "model/plane_cut.h"

namespace koshi::io {
namespace {

/// What a part of the surface gives its cell, in cells: its area times the normal, and the volume between it and the
/// cell's upper face across x.
struct Part {
  std::int64_t row = 0, i = 0;  ///< cell i of a row along x; -1: below the first
  Vec3 area{};
  double above = 0;
};

// Places counted in cells. A float of the file that means a plane between cells is taken for one.
Vec3 in_cells(const Vec3& corner, const lattice::Grid& grid) {
  Vec3 place{};
  for (std::size_t a = 0; a < 3; ++a) {
    const double x = (corner[a] - grid.origin[a]) / grid.d, near = std::round(x);
    place[a] = std::abs(x - near) < 1e-6 * (1 + std::abs(x)) ? near : x;
  }
  return place;
}

std::vector<Part> parts_of(const std::vector<Triangle>& placed, const Int3& n) {
  double low = 0;
  for (const Triangle& triangle : placed)
    for (const Vec3& corner : triangle) low = std::min(low, std::floor(corner[0]));
  const Int3 first{static_cast<std::int64_t>(low), 0, 0};
  std::vector<Part> parts;
  for (const Triangle& triangle : placed)
    model::for_each_part({triangle.begin(), triangle.end()}, 0, first, n, {},
                         [&](const Int3& cell, const auto& polygon) {
                           Part part{cell[1] + n[1] * cell[2], std::max<std::int64_t>(cell[0], -1), {}, 0};
                           for (std::size_t v = 2; v < polygon.size(); ++v) {
                             const Vec3 area = 0.5 * cross(polygon[v - 1] - polygon[0], polygon[v] - polygon[0]);
                             const double middle = (polygon[0][0] + polygon[v - 1][0] + polygon[v][0]) / 3;
                             part.area = part.area + area;
                             part.above += area[0] * (static_cast<double>(cell[0] + 1) - middle);
                           }
                           parts.push_back(part);
                         });
  std::stable_sort(parts.begin(), parts.end(),
                   [](const Part& a, const Part& b) { return std::pair(a.row, a.i) < std::pair(b.row, b.i); });
  return parts;
}

}  // namespace

std::vector<Triangle> outward_triangles(const std::filesystem::path& file, double scale) {
  std::vector<Triangle> triangles = read_stl(file);
  const Closure closure = closure_of(triangles);
  check_closed(closure);
  if (!closure.oriented)
    throw InputError(
        "has triangles that do not all face outwards, so what is inside cannot be measured; turn them, or set surface "
        "= "
        "\"stairs\" in [body] and give the region no name");
  double volume = 0;
  for (Triangle& triangle : triangles) {
    volume += dot(triangle[0], cross(triangle[1], triangle[2]));
    for (Vec3& corner : triangle) corner = scale * corner;
  }
  if (volume < 0)
    for (Triangle& triangle : triangles) std::swap(triangle[1], triangle[2]);
  return triangles;
}

std::vector<model::CutCell> cells_cut(const std::filesystem::path& file, double scale, const lattice::Grid& grid) {
  std::vector<Triangle> placed = outward_triangles(file, scale);
  for (Triangle& triangle : placed)
    for (Vec3& corner : triangle) corner = in_cells(corner, grid);

  // Along a row of cells the mean number of times that the surface winds around what lies behind is minus the sum of
  // the areas passed, seen along x; the cell's own parts count from where they are to its upper face.
  const Int3& n = grid.cells;
  const std::vector<Part> parts = parts_of(placed, n);
  std::vector<model::CutCell> cut;
  double passed = 0;
  for (std::size_t p = 0; p < parts.size();) {
    const Part& first = parts[p];
    if (p == 0 || parts[p - 1].row != first.row) passed = 0;
    Vec3 area{};
    double above = 0;
    for (; p < parts.size() && parts[p].row == first.row && parts[p].i == first.i; ++p) {
      area = area + parts[p].area;
      above += parts[p].above;
    }
    const double part = -passed - above;
    passed += area[0];
    if (first.i < 0) continue;
    constexpr double slack = 1e-6;
    if (part < -slack || part > 1 + slack) {
      const Int3 cell{first.i, first.row % n[1], first.row / n[1]};
      const Vec3 at = (1 / scale) * (grid.position(cell) + Vec3{0.5 * grid.d, 0.5 * grid.d, 0.5 * grid.d});
      throw InputError(
          fmt::format("crosses or overlaps itself near ({:.4g}, {:.4g}, {:.4g}) in the file's unit, so what is inside "
                      "cannot be measured; unite its parts, or set surface = \"stairs\" in [body]",
                      at[0], at[1], at[2]));
    }
    const double size = norm(area);
    const Vec3 normal = size > 1e-9 ? (1 / size) * area : Vec3{1, 0, 0};
    cut.push_back({first.i + n[0] * first.row, normal, model::offset_of_part(normal, std::clamp(part, 0.0, 1.0))});
  }
  return cut;
}

}  // namespace koshi::io
