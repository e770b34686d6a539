#include "model/regions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace koshi::model {
namespace {

std::uint8_t index_of(const Definition& definition, const std::string& name, const std::string& path) {
  if (name == "void") return 0;
  for (std::size_t m = 0; m < definition.materials.size(); ++m)
    if (definition.materials[m].name == name) return static_cast<std::uint8_t>(m + 1);
  throw InputError(definition.places.find(path),
                   fmt::format("there is no material \"{}\"; define [material.{}]", name, name));
}

// Cells are compared by their centres; borders that touch a centre belong to the region, whatever the last bit says.
bool inside(const RegionDefinition& region, const Vec3& x, double d) {
  const double slack = 1e-9 * d;
  using Shape = RegionDefinition::Shape;
  switch (region.shape) {
    case Shape::box:
      for (int a = 0; a < 3; ++a)
        if (x[a] < region.min[a] - slack || x[a] > region.max[a] + slack) return false;
      return true;
    case Shape::sphere:
      return norm(x - region.center) <= region.radius + slack;
    case Shape::cylinder: {
      const Vec3 axis = region.end - region.start;
      const double length = norm(axis);
      const double along = dot(x - region.start, axis) / length;
      if (along < -slack || along > length + slack) return false;
      return norm(cross(x - region.start, axis)) / length <= region.radius + slack;
    }
    case Shape::half_space:
      return dot(x - region.point, region.normal) <= slack * norm(region.normal);
    case Shape::stl:
      break;
  }
  return false;
}

}  // namespace

lattice::Grid make_grid(const Definition& definition) {
  lattice::Grid grid;
  grid.d = definition.lattice.spacing;
  grid.origin = definition.body.origin;
  grid.periodic = definition.body.periodic;
  double total = 1;
  for (int a = 0; a < 3; ++a) {
    const double cells = definition.body.size[a] / grid.d;
    const double whole = std::round(cells);
    if (!(whole >= 1) || std::abs(cells - whole) > 1e-6 * whole)
      throw InputError(
          definition.places.find("body.size"),
          fmt::format("size {:.9g} m along {} is no positive multiple of the spacing {:.9g} m; nearest: {:.9g} m",
                      definition.body.size[a], "xyz"[a], grid.d, std::max(whole, 1.0) * grid.d));
    total *= whole + 1;
    if (!(total < 1e15))
      throw InputError(
          definition.places.find("body.size"),
          fmt::format("the body would have more than {:.1g} nodes; use a larger spacing or a smaller body", total));
    grid.cells[a] = static_cast<std::int64_t>(whole);
  }
  return grid;
}

std::function<std::uint8_t(const Int3&)> material_of_cells(const Definition& definition, const lattice::Grid& grid) {
  if (definition.materials.size() > SpringLattice::max_materials)
    throw InputError(definition.places.find("material"),
                     fmt::format("{} materials, but a cell's material is one byte: at most {}",
                                 definition.materials.size(), SpringLattice::max_materials));
  const std::vector<std::uint8_t>& image = definition.body.cells;
  const Int3 n = grid.cells;
  if (!image.empty() && static_cast<std::int64_t>(image.size()) != n[0] * n[1] * n[2])
    throw InputError(
        definition.places.find("body"),
        fmt::format("the cell materials have {} entries, the body {} x {} x {} cells", image.size(), n[0], n[1], n[2]));
  for (const std::uint8_t m : image)
    if (m > definition.materials.size())
      throw InputError(definition.places.find("body"),
                       fmt::format("cell material {} is not defined; there are {}", m, definition.materials.size()));
  const std::uint8_t background = image.empty() ? index_of(definition, definition.body.material, "body.material") : 0;
  std::vector<std::uint8_t> region_material;
  for (std::size_t r = 0; r < definition.regions.size(); ++r)
    region_material.push_back(
        index_of(definition, definition.regions[r].material, fmt::format("region[{}].material", r)));

  return [&definition, &image, grid, n, background, region_material](const Int3& cell) {
    const auto at = static_cast<std::size_t>(cell[0] + n[0] * (cell[1] + n[1] * cell[2]));
    const Vec3 centre = grid.position(cell) + Vec3{0.5 * grid.d, 0.5 * grid.d, 0.5 * grid.d};
    for (std::size_t r = definition.regions.size(); r-- > 0;) {
      const RegionDefinition& region = definition.regions[r];
      const bool in = region.shape == RegionDefinition::Shape::stl ? at < region.inside.size() && region.inside[at] != 0
                                                                   : inside(region, centre, grid.d);
      if (in) return region_material[r];
    }
    return image.empty() ? background : image[at];
  };
}

}  // namespace koshi::model
