#include "model/moments.h"

#include <algorithm>

#include "model/clip.h"
#include "model/triangle_points.h"

namespace koshi::model {
namespace {

void add_powers(const Vec3& x, double weight, Moments& sum) {
  const std::array<Vec3, 3> power{Vec3{1, 1, 1}, x, Vec3{x[0] * x[0], x[1] * x[1], x[2] * x[2]}};
  for (std::size_t m = 0; m < sum.size(); ++m) {
    const Powers& p = moment_powers[m];
    sum[m] += weight * power[static_cast<std::size_t>(p.x)][0] * power[static_cast<std::size_t>(p.y)][1] *
              power[static_cast<std::size_t>(p.z)][2];
  }
}

// Integrals over a flat polygon.
Moments over_face(const Polygon& polygon) {
  Moments sum{};
  for (std::size_t v = 2; v < polygon.size(); ++v) {
    const Vec3 &a = polygon[0], &b = polygon[v - 1], &c = polygon[v];
    const double area = 0.5 * norm(cross(b - a, c - a));
    for_each_point(a, b, c, [&](const Vec3& place, double share) { add_powers(place, share * area, sum); });
  }
  return sum;
}

// The part of a convex polygon where normal . x <= offset.
Polygon below(const Polygon& polygon, const Vec3& normal, double offset) {
  Polygon part;
  for (std::size_t v = 0; v < polygon.size(); ++v) {
    const Vec3 &a = polygon[v], &b = polygon[(v + 1) % polygon.size()];
    const double at_a = dot(normal, a) - offset, at_b = dot(normal, b) - offset;
    if (at_a <= 0) part.push_back(a);
    if ((at_a < 0 && at_b > 0) || (at_a > 0 && at_b < 0)) part.push_back(a + (at_a / (at_a - at_b)) * (b - a));
  }
  return part;
}

// A face of the cube across an axis.
Polygon face_of(const PartCube& cube, std::size_t axis, double side) {
  Polygon face;
  for (const auto& [p, q] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    Vec3 corner = cube.centre;
    corner[axis] += side * cube.half;
    corner[(axis + 1) % 3] += p * cube.half;
    corner[(axis + 2) % 3] += q * cube.half;
    face.push_back(corner);
  }
  return face;
}

// The plane normal . x = offset inside the cube; `normal` has length 1.
Polygon section_of(const PartCube& cube, const Vec3& normal, double offset) {
  // A square in the plane that is larger than the section, cut by the six faces.
  const auto [u, v] = across(normal);
  const Vec3 along = 4 * cube.half * u, side = 4 * cube.half * v;
  const Vec3 middle = cube.centre + (offset - dot(normal, cube.centre)) * normal;
  Polygon section{middle - along - side, middle + along - side, middle + along + side, middle - along + side};
  for (std::size_t a = 0; a < 3 && !section.empty(); ++a) {
    section = split(section, a, cube.centre[a] - cube.half).second;
    section = split(section, a, cube.centre[a] + cube.half).first;
  }
  return section;
}

}  // namespace

Moments moments_of_cube(const PartCube& cube) {
  // Along an axis the integrals of 1, x and x^2; the cell is 2 x 2 x 2.
  std::array<Vec3, 3> line;
  for (std::size_t a = 0; a < 3; ++a) {
    const double c = cube.centre[a], h = cube.half;
    line[a] = {h, h * c, h * (c * c + h * h / 3)};
  }
  Moments moments;
  for (std::size_t m = 0; m < moments.size(); ++m) {
    const Powers& p = moment_powers[m];
    moments[m] = line[0][static_cast<std::size_t>(p.x)] * line[1][static_cast<std::size_t>(p.y)] *
                 line[2][static_cast<std::size_t>(p.z)];
  }
  return moments;
}

Moments moments_below(const PartCube& cube, const Vec3& normal, double offset) {
  const Vec3 unit = (1 / norm(normal)) * normal;
  const double from_centre = offset / norm(normal), distance = from_centre + dot(unit, cube.centre);
  // A section on a face would count twice.
  const double reach = cube.half * (std::abs(unit[0]) + std::abs(unit[1]) + std::abs(unit[2]));
  const double least = 1e-12 * cube.half;
  if (from_centre >= reach - least) return moments_of_cube(cube);
  if (from_centre <= least - reach) return {};
  // For f of degree q, div(x f) = (3 + q) f: the integral of f over the part is the sum over its faces of (x . n) times
  // that of f over the face, over 3 + q. On a flat face x . n is the distance of its plane.
  Moments sum{};
  const auto add = [&sum](const Polygon& face, double height) {
    const Moments of_face = over_face(face);
    for (std::size_t m = 0; m < sum.size(); ++m) sum[m] += height * of_face[m];
  };
  for (std::size_t a = 0; a < 3; ++a)
    for (const double side : {-1.0, 1.0})
      add(below(face_of(cube, a, side), unit, distance), side * cube.centre[a] + cube.half);
  add(section_of(cube, unit, distance), distance);
  for (std::size_t m = 0; m < sum.size(); ++m) {
    const Powers& p = moment_powers[m];
    sum[m] /= 8.0 * (3 + p.x + p.y + p.z);
  }
  return sum;
}

}  // namespace koshi::model
