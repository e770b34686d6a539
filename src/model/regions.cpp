#include "model/regions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "model/check.h"
#include "model/cut.h"
#include "model/grains.h"

namespace koshi::model {
namespace {

// Cells are compared by their centres; borders that touch a centre belong to the region, whatever the last bit says.
bool inside(const std::vector<Primitive>& primitives, const Vec3& x, double d) {
  const double slack = 1e-9 * d;
  return std::all_of(primitives.begin(), primitives.end(),
                     [&](const Primitive& primitive) { return primitive.distance(x) <= slack; });
}

}  // namespace

std::uint16_t material_index(const Definition& definition, const std::string& name) {
  if (name == "void") return 0;
  const auto& materials = definition.materials;
  const auto found = std::find_if(materials.begin(), materials.end(), [&](const auto& m) { return m.name == name; });
  assert(found != materials.end());
  return static_cast<std::uint16_t>(found - materials.begin() + 1);
}

lattice::Grid make_grid(const Definition& definition) {
  const Checker check(definition);
  lattice::Grid grid;
  grid.d = definition.lattice.spacing;
  grid.origin = definition.body.origin;
  grid.periodic = definition.body.periodic;
  double nodes = 1;
  for (std::size_t a = 0; a < 3; ++a) {
    const double size = definition.body.size[a];
    const double cells = size / grid.d;
    const double whole = std::round(cells);
    // Sizes and spacing are rounded decimals: a millionth of a cell is no difference.
    constexpr double slack = 1e-6;
    if (!(whole >= 1) || !(std::abs(cells - whole) <= slack)) {
      const double below = std::floor(cells) * grid.d;
      const std::string nearest = cells > 1 ? fmt::format("sizes: {:.12g} m, {:.12g} m", below, below + grid.d)
                                            : fmt::format("size: {:.12g} m", grid.d);
      check.fail(fmt::format("body.size[{}]", a),
                 fmt::format("size along {} is {:.12g} m, no positive multiple of the spacing {:.12g} m; the nearest "
                             "right {}",
                             "xyz"[a], size, grid.d, nearest));
    }
    // More could not be counted in a double or an index, let alone stored.
    constexpr double most = 1e15;
    nodes *= whole + 1;
    if (!(nodes < most))
      check.fail(
          fmt::format("body.size[{}]", a),
          fmt::format("the body would have more than {:.0e} nodes; use a larger spacing or a smaller body", most));
    grid.cells[a] = static_cast<std::int64_t>(whole);
    // Coordinates keep 16 digits: of a cell, far from zero, a millionth must be left.
    constexpr double farthest = 1e9;
    if (std::abs(grid.origin[a]) > farthest * grid.d)
      check.fail(fmt::format("body.origin[{}]", a),
                 fmt::format("origin along {} is {:.12g} m, more than {:.0e} cells of {:.6g} m away from zero, where "
                             "coordinates no longer tell them apart; move the body nearer",
                             "xyz"[a], grid.origin[a], farthest, grid.d));
  }
  return grid;
}

std::function<std::uint16_t(const Int3&)> material_of_grains(const Definition& definition, const lattice::Grid& grid) {
  const std::vector<std::uint16_t>& image = definition.body.cells;
  const Int3 n = grid.cells;
  if (!image.empty() && static_cast<std::int64_t>(image.size()) != n[0] * n[1] * n[2])
    throw InputError(
        definition.places.find("body"),
        fmt::format("the cell materials have {} entries, the body {} x {} x {} cells", image.size(), n[0], n[1], n[2]));
  for (const std::uint16_t m : image)
    if (m > definition.materials.size())
      throw InputError(definition.places.find("body"),
                       fmt::format("cell material {} is not defined; there are {}", m, definition.materials.size()));
  if (definition.cuts())
    return [body = CutBody(definition, grid)](const Int3& cell) { return body.part_of(cell).material; };
  const std::uint16_t background = image.empty() ? material_index(definition, definition.body.material) : 0;
  std::vector<std::uint16_t> region_material;
  std::vector<std::vector<Primitive>> primitives;
  for (const RegionDefinition& region : definition.regions) {
    region_material.push_back(material_index(definition, region.material));
    primitives.push_back(primitives_of(region));
  }

  return [&definition, &image, grid, n, background, region_material, primitives](const Int3& cell) {
    const auto at = static_cast<std::size_t>(cell[0] + n[0] * (cell[1] + n[1] * cell[2]));
    const Vec3 centre = grid.position(cell) + Vec3{0.5 * grid.d, 0.5 * grid.d, 0.5 * grid.d};
    for (std::size_t r = definition.regions.size(); r-- > 0;) {
      const RegionDefinition& region = definition.regions[r];
      const bool in = region.shape == RegionDefinition::Shape::stl ? at < region.inside.size() && region.inside[at] != 0
                                                                   : inside(primitives[r], centre, grid.d);
      if (in) return region_material[r];
    }
    return image.empty() ? background : image[at];
  };
}

std::function<std::uint16_t(const Int3&)> material_of_cells(const Definition& definition, const lattice::Grid& grid) {
  const auto material_of = material_of_grains(definition, grid);
  const auto& boundary = definition.body.grain_boundary;
  if (!boundary || boundary->material.empty()) return material_of;
  return [material_of, on_boundary = grain_boundaries(definition, grid),
          between = material_index(definition, boundary->material)](const Int3& cell) {
    return on_boundary(cell) ? between : material_of(cell);
  };
}

std::function<float(const Int3&)> fraction_of_cells(const Definition& definition, const lattice::Grid& grid) {
  if (!definition.cuts()) return nullptr;
  return
      [body = CutBody(definition, grid)](const Int3& cell) { return static_cast<float>(body.part_of(cell).fraction); };
}

std::function<Moments(const Int3&)> moments_of_cells(const Definition& definition, const lattice::Grid& grid) {
  return [body = CutBody(definition, grid)](const Int3& cell) { return body.moments_of(cell); };
}

std::function<float(const Int3&)> factor_of_cells(const Definition& definition, const lattice::Grid& grid) {
  const std::vector<float>& factors = definition.body.factors;
  if (factors.empty()) return nullptr;
  const Int3 n = grid.cells;
  const Checker check(definition);
  if (static_cast<std::int64_t>(factors.size()) != n[0] * n[1] * n[2])
    check.fail("body.factor", fmt::format("there are factors for {} cells, but the body has {} x {} x {}",
                                          factors.size(), n[0], n[1], n[2]));
  for (std::size_t at = 0; at < factors.size(); ++at)
    if (!(factors[at] >= 0 && factors[at] <= 1)) {
      const auto cell = static_cast<std::int64_t>(at);
      check.fail("body.factor", fmt::format("the factor of cell ({}, {}, {}) is {:.6g}; factors lie between 0 and 1",
                                            cell % n[0], cell / n[0] % n[1], cell / (n[0] * n[1]), factors[at]));
    }
  return [&factors, n](const Int3& cell) {
    return factors[static_cast<std::size_t>(cell[0] + n[0] * (cell[1] + n[1] * cell[2]))];
  };
}

std::function<double(Int3)> density_share_of_cells(const Definition& definition, const lattice::Grid& grid) {
  const std::vector<float>& shares = definition.body.density_shares;
  if (shares.empty()) return nullptr;
  const Int3 n = grid.cells;
  if (static_cast<std::int64_t>(shares.size()) != n[0] * n[1] * n[2])
    Checker(definition)
        .fail("body.image", fmt::format("there are densities for {} cells, but the body has {} x {} x {}",
                                        shares.size(), n[0], n[1], n[2]));
  return [&shares, n](Int3 cell) {
    for (std::size_t a = 0; a < 3; ++a) cell[a] = (cell[a] + n[a]) % n[a];
    return static_cast<double>(shares[static_cast<std::size_t>(cell[0] + n[0] * (cell[1] + n[1] * cell[2]))]);
  };
}

}  // namespace koshi::model
