#include "model/region_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <unordered_map>

#include "model/clip.h"
#include "model/cut.h"
#include "model/regions.h"

namespace koshi::model {
namespace {

// Facets so small that their sagitta is a few thousandths of a cell, whatever the radius.
int facets(double radius, double d) {
  const double edge = std::sqrt(d * radius) / 8;
  return std::max(48, static_cast<int>(std::ceil(2 * std::numbers::pi * radius / edge)));
}

std::vector<Polygon> sphere_surface(const RegionDefinition& region, double d) {
  const int around = facets(region.radius, d), rows = around / 2;
  const auto point = [&](int row, int side) {
    if (row == 0 || row == rows) return region.center + Vec3{0, 0, row == 0 ? -region.radius : region.radius};
    const double theta = std::numbers::pi * row / rows, phi = 2 * std::numbers::pi * (side % around) / around;
    return region.center +
           region.radius * Vec3{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), -std::cos(theta)};
  };
  std::vector<Polygon> polygons;
  for (int row = 0; row < rows; ++row)
    for (int side = 0; side < around; ++side) {
      // At the poles one of the two triangles is a line.
      const Vec3 a = point(row, side), b = point(row, side + 1), c = point(row + 1, side + 1), e = point(row + 1, side);
      if (row > 0) polygons.push_back({a, b, c});
      if (row + 1 < rows) polygons.push_back({a, c, e});
    }
  // As far outside as inside: they enclose the ball's volume.
  double volume = 0;
  for (const Polygon& p : polygons)
    volume += dot(p[0] - region.center, cross(p[1] - region.center, p[2] - region.center)) / 6;
  const double ball = 4 * std::numbers::pi / 3 * std::pow(region.radius, 3), scale = std::cbrt(ball / volume);
  for (Polygon& p : polygons)
    for (Vec3& corner : p) corner = region.center + scale * (corner - region.center);
  return polygons;
}

std::vector<Polygon> cylinder_surface(const RegionDefinition& region, double d) {
  const Vec3 along = region.end - region.start;
  const auto [u, v] = across((1 / norm(along)) * along);
  const int around = facets(region.radius, d);
  // The facets leave the surface by as much outwards as inwards: they enclose the same volume.
  const double angle = 2 * std::numbers::pi / around, radius = region.radius * std::sqrt(angle / std::sin(angle));
  const auto rim = [&, u = u, v = v](int side) {
    const double phi = angle * (side % around);
    return radius * (std::cos(phi) * u + std::sin(phi) * v);
  };
  std::vector<Polygon> polygons;
  for (int side = 0; side < around; ++side) {
    const Vec3 a = region.start + rim(side), b = region.start + rim(side + 1);
    polygons.push_back({a, b, b + along, a + along});
    polygons.push_back({region.start, b, a});
    polygons.push_back({region.end, a + along, b + along});
  }
  return polygons;
}

std::vector<Polygon> box_surface(const Vec3& lo, const Vec3& hi) {
  std::vector<Polygon> polygons;
  for (std::size_t a = 0; a < 3; ++a)
    for (const bool upper : {false, true}) {
      const std::size_t b = (a + 1) % 3, c = (a + 2) % 3;
      Vec3 x = lo;
      x[a] = upper ? hi[a] : lo[a];
      Polygon side{x, x, x, x};
      side[1][b] = side[2][b] = hi[b];
      side[2][c] = side[3][c] = hi[c];
      if (!upper) std::reverse(side.begin(), side.end());
      polygons.push_back(std::move(side));
    }
  return polygons;
}

std::vector<Polygon> plane_surface(const RegionDefinition& region, const lattice::Grid& grid) {
  // A square that reaches beyond the whole box of cells.
  const Vec3 lo = grid.position({0, 0, 0}), hi = grid.position(grid.cells);
  const Vec3 normal = (1 / norm(region.normal)) * region.normal, middle = 0.5 * (lo + hi);
  const Vec3 foot = middle - dot(middle - region.point, normal) * normal;
  const auto [u, v] = across(normal);
  const double reach = norm(hi - lo);
  return {{foot + reach * (-1.0 * u - v), foot + reach * (u - v), foot + reach * (u + v), foot + reach * (v - u)}};
}

std::vector<Polygon> polygons_of(const RegionDefinition& region, const lattice::Grid& grid) {
  using Shape = RegionDefinition::Shape;
  switch (region.shape) {
    case Shape::box:
      return box_surface(region.min, region.max);
    case Shape::sphere:
      return sphere_surface(region, grid.d);
    case Shape::cylinder:
      return cylinder_surface(region, grid.d);
    case Shape::half_space:
      return plane_surface(region, grid);
    case Shape::stl:
      break;
  }
  std::vector<Polygon> polygons;
  for (const auto& triangle : region.triangles) polygons.emplace_back(triangle.begin(), triangle.end());
  return polygons;
}

/// Solid cells of the body, looked up by their global indices.
class SolidCells {
 public:
  SolidCells(const Definition& definition, const lattice::Grid& grid)
      : grid_(grid), material_of_(material_of_cells(definition, grid)) {}

  bool solid(const Int3& cell) {
    for (std::size_t a = 0; a < 3; ++a)
      if (cell[a] < 0 || cell[a] >= grid_.cells[a]) return false;
    const std::int64_t at = cell[0] + grid_.cells[0] * (cell[1] + grid_.cells[1] * cell[2]);
    const auto [entry, fresh] = known_.try_emplace(at, false);
    if (fresh) entry->second = material_of_(cell) != 0;
    return entry->second;
  }

  /// The cell itself, or the solid one within two cells that is closest to a place counted in cells.
  std::optional<Int3> closest(const Int3& cell, const Vec3& place) {
    if (solid(cell)) return cell;
    std::optional<Int3> found;
    double least = 0;
    for (std::int64_t k = -2; k <= 2; ++k)
      for (std::int64_t j = -2; j <= 2; ++j)
        for (std::int64_t i = -2; i <= 2; ++i) {
          const Int3 other{cell[0] + i, cell[1] + j, cell[2] + k};
          double square = 0;
          for (std::size_t a = 0; a < 3; ++a) {
            const double from = static_cast<double>(other[a]);
            const double beyond = std::max({from - place[a], place[a] - from - 1, 0.0});
            square += beyond * beyond;
          }
          if ((found && square >= least) || !solid(other)) continue;
          found = other;
          least = square;
        }
    return found;
  }

 private:
  lattice::Grid grid_;
  std::function<std::uint16_t(const Int3&)> material_of_;
  std::unordered_map<std::int64_t, bool> known_;
};

// Centroid of a polygon, and its area times its normal: by the triangles about the first corner.
std::pair<Vec3, Vec3> middle_of(const Polygon& part) {
  Vec3 area{}, moment{};
  double weight = 0;
  for (std::size_t v = 2; v < part.size(); ++v) {
    const Vec3 triangle = 0.5 * cross(part[v - 1] - part[0], part[v] - part[0]);
    const double size = norm(triangle);
    area = area + triangle;
    weight += size;
    moment = moment + (size / 3) * (part[0] + part[v - 1] + part[v]);
  }
  return {weight > 0 ? (1 / weight) * moment : part[0], area};
}

}  // namespace

std::vector<SurfacePiece> surface_of(const Definition& definition, const lattice::Grid& grid, int region,
                                     SurfaceEdges edges) {
  const CutBody body(definition, grid);
  SolidCells cells(definition, grid);
  const auto position = [&](const Vec3& place) { return grid.origin + grid.d * place; };
  // Whether the body is solid a little beside a piece, the region itself taken as there or not.
  const auto solid_beside = [&](const Vec3& place, bool holds) {
    Int3 cell;
    for (std::size_t a = 0; a < 3; ++a) {
      cell[a] = static_cast<std::int64_t>(std::floor(place[a]));
      if (cell[a] < 0 || cell[a] >= grid.cells[a]) return false;
    }
    return body.material_at(position(place), cell, region, holds) != 0;
  };
  // On which sides of a place of the surface the body is.
  const auto sides = [&](const Vec3& place, const Vec3& normal) {
    constexpr double beside = 1e-3;
    return std::pair(solid_beside(place - beside * normal, true), solid_beside(place + beside * normal, false));
  };

  std::vector<SurfacePiece> pieces;
  const auto add = [&](const Int3& cell, const Polygon& part) {
    const auto [place, area] = middle_of(part);
    if (norm(area) < 1e-14) return;
    const auto [in, out] = sides(place, (1 / norm(area)) * area);
    if (in == out) return;
    const auto home = cells.closest(cell, place);
    if (!home && edges == SurfaceEdges::fine) return;
    if (!home) {
      const Vec3 at = position(place);
      throw InputError(
          fmt::format("the surface near ({:.6g}, {:.6g}, {:.6g}) m bounds a part of the body so thin "
                      "that no cell there is solid; use a smaller spacing",
                      at[0], at[1], at[2]));
    }
    Polygon corners;
    for (const Vec3& x : part) corners.push_back(position(x));
    pieces.push_back({*home, position(place), (in ? 1 : -1) * grid.d * grid.d * area, std::move(corners), region});
  };
  // Whether another surface ends this one within a part: its corners have the body on other sides than its middle.
  const auto ends_within = [&](const Polygon& part) {
    const auto [place, area] = middle_of(part);
    if (norm(area) < 1e-14) return false;
    const Vec3 middle = place, normal = (1 / norm(area)) * area;
    const auto there = sides(middle, normal);
    return std::ranges::any_of(part, [&](const Vec3& x) { return sides(x + 0.01 * (middle - x), normal) != there; });
  };
  constexpr std::int64_t fine = 8;
  for (const Polygon& polygon : polygons_of(definition.regions[static_cast<std::size_t>(region)], grid)) {
    Polygon placed;
    for (const Vec3& x : polygon) placed.push_back((1 / grid.d) * (x - grid.origin));
    for_each_part(placed, 0, {0, 0, 0}, grid.cells, {}, [&](const Int3& cell, const Polygon& part) {
      if (edges == SurfaceEdges::pieces || !ends_within(part)) return add(cell, part);
      Vec3 corner;
      for (std::size_t a = 0; a < 3; ++a) corner[a] = static_cast<double>(cell[a]);
      Polygon large;
      for (const Vec3& x : part) large.push_back(fine * (x - corner));
      for_each_part(large, 0, {0, 0, 0}, {fine, fine, fine}, {}, [&](const Int3&, const Polygon& piece) {
        Polygon small;
        for (const Vec3& x : piece) small.push_back(corner + (1.0 / fine) * x);
        add(cell, small);
      });
    });
  }
  return pieces;
}

}  // namespace koshi::model
