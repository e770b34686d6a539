#include "model/surface_supports.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "model/regions.h"
#include "model/selection.h"
#include "model/shapes.h"
#include "model/surface_loads.h"

namespace koshi::model {
namespace {

// Pieces of one surface in a cell whose normals differ by less than 45 degrees.
struct Patch {
  Vec3 moment{};    // sum of size times centroid
  Vec3 area{};      // sum of area times normal [m^2]
  double size = 0;  // [m^2]
  Int3 home{};      // solid cell of the first piece
  int region = 0;

  Vec3 centroid() const { return (1 / size) * moment; }
  Vec3 normal() const { return (1 / norm(area)) * area; }
};

// By the cell they lie in, x fastest.
using Patches = std::map<std::array<std::int64_t, 3>, std::vector<Patch>>;

Patches patches_of(const lattice::Grid& grid, const std::vector<SurfacePiece>& pieces) {
  Patches patches;
  for (const SurfacePiece& piece : pieces) {
    std::array<std::int64_t, 3> place;
    for (std::size_t a = 0; a < 3; ++a)
      place[2 - a] = static_cast<std::int64_t>(std::floor((piece.at[a] - grid.origin[a]) / grid.d));
    const double size = norm(piece.area);
    std::vector<Patch>& there = patches[place];
    auto patch = std::ranges::find_if(there, [&](const Patch& p) {
      return p.region == piece.region && dot(p.normal(), piece.area) > std::sqrt(0.5) * size;
    });
    if (patch == there.end()) patch = there.insert(there.end(), Patch{{}, {}, 0, piece.cell, piece.region});
    patch->moment = patch->moment + size * piece.at;
    patch->area = patch->area + piece.area;
    patch->size += size;
  }
  return patches;
}

/// The normal of a region's surface near a place, on the side of a rough one: that of the smooth surface, so that a
/// body of revolution turns freely in its support. A surface from a file is what its triangles are.
Vec3 true_normal(const RegionDefinition& region, const Vec3& x, const Vec3& rough) {
  Vec3 best = rough;
  double likeness = std::sqrt(0.5);
  for (const Primitive& surface : primitives_of(region)) {
    Vec3 normal = surface.axis;
    if (surface.kind != Primitive::Kind::plane) {
      normal = x - surface.point;
      if (surface.kind == Primitive::Kind::bar) normal = normal - dot(normal, surface.axis) * surface.axis;
      normal = (1 / norm(normal)) * normal;
    }
    const double like = dot(normal, rough);
    if (std::abs(like) <= likeness) continue;
    likeness = std::abs(like);
    best = (like > 0 ? 1 : -1) * normal;
  }
  return best;
}

/// Adds springs of this rank.
class SpringMaker {
 public:
  explicit SpringMaker(const Model& model)
      : model_(model),
        grid_(model.lattice.grid),
        material_of_(material_of_cells(model.definition, model.lattice.grid)),
        fraction_of_(fraction_of_cells(model.definition, model.lattice.grid)) {}

  void add(const Patch& patch, const RegionDefinition& region, BoundaryDefinition::Support support) {
    const Vec3 normal = true_normal(region, patch.centroid(), patch.normal());
    const Vec3 at = patch.centroid() - support_depth * grid_.d * normal;
    Int3 cell = cell_of(at);
    if (!solid(cell)) cell = patch.home;
    const auto& material = model_.materials[material_of_(cell)];
    const double per_modulus = patch.size / (support_layer(fraction_of(cell_of(patch.centroid()))) * grid_.d);
    const GroundSpring along{
        0, {}, normal, (material.lambda() + 2 * material.mu()) * per_modulus, patch.centroid(), patch.region};
    add(cell, at, along);
    if (support == BoundaryDefinition::Support::roller) return;
    for (const Vec3& side : across(normal)) {
      GroundSpring sideways = along;
      sideways.direction = side;
      sideways.stiffness = material.mu() * per_modulus;
      add(cell, at, sideways);
    }
  }

  std::vector<GroundSpring> springs;

 private:
  Int3 cell_of(const Vec3& x) const {
    Int3 cell;
    for (std::size_t a = 0; a < 3; ++a)
      cell[a] = static_cast<std::int64_t>(std::floor((x[a] - grid_.origin[a]) / grid_.d));
    return cell;
  }

  bool solid(const Int3& cell) const {
    for (std::size_t a = 0; a < 3; ++a)
      if (cell[a] < 0 || cell[a] >= grid_.cells[a]) return false;
    return material_of_(cell) != 0;
  }

  // Of a cell; without fractions it is whole or empty.
  double fraction_of(const Int3& cell) const {
    if (!solid(cell)) return 0;
    return fraction_of_ ? static_cast<double>(fraction_of_(cell)) : 1;
  }

  // A cell that touches an owned node has an index from -1 on; across a period it may have two.
  void add(const Int3& cell, const Vec3& at, GroundSpring spring) {
    const lattice::Layout& layout = model_.layout();
    const auto shares = corner_shares(grid_, cell, at);
    for (std::size_t c = 0; c < 8; ++c) spring.weights[c] = shares[c].weight;
    const auto first = layout.local(cell);
    std::array<std::vector<std::int64_t>, 3> places;
    for (std::size_t a = 0; a < 3; ++a)
      for (const std::int64_t period : {grid_.cells[a], std::int64_t{0}}) {
        const std::int64_t local = first[a] - period;
        if (period != 0 && !grid_.periodic[a]) continue;
        if (local >= -1 && local < layout.owned()[a]) places[a].push_back(local);
      }
    for (const std::int64_t k : places[2])
      for (const std::int64_t j : places[1])
        for (const std::int64_t i : places[0]) {
          spring.cell = layout.index(i, j, k);
          springs.push_back(spring);
        }
  }

  const Model& model_;
  const lattice::Grid& grid_;
  std::function<std::uint16_t(const Int3&)> material_of_;
  std::function<float(const Int3&)> fraction_of_;
};

}  // namespace

double support_layer(double fraction) {
  constexpr double e = support_depth;
  // The spring's place lies in the cell itself, or in the whole one below it.
  return fraction > e ? 2 * e - e * e / fraction : 1 + fraction - (1 + fraction - e) * (1 + fraction - e);
}

std::vector<GroundSpring> make_supports(const Model& model) {
  const Definition& definition = model.definition;
  SpringMaker maker(model);
  for (std::size_t b = 0; b < definition.boundaries.size(); ++b) {
    const BoundaryDefinition& boundary = definition.boundaries[b];
    if (!boundary.support) continue;
    const std::string path = fmt::format("boundary[{}]", b);
    const std::string title =
        boundary.name.empty() ? fmt::format("boundary {}", b + 1) : fmt::format("boundary \"{}\"", boundary.name);
    const auto pieces =
        selected_pieces(model, boundary.selection, surfaces_of(boundary.selection, definition), path, title);
    for (const auto& [place, patches] : patches_of(model.lattice.grid, pieces))
      for (const Patch& patch : patches)
        maker.add(patch, definition.regions[static_cast<std::size_t>(patch.region)], *boundary.support);
  }
  return std::move(maker.springs);
}

}  // namespace koshi::model
