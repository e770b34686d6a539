#include "model/surface_loads.h"

#include <fmt/format.h>

#include <map>

#include "model/region_surface.h"
#include "model/selection.h"

namespace koshi::model {
namespace {

std::vector<SurfacePiece> selected_pieces(const Model& model, const LoadDefinition& load,
                                          const std::vector<int>& regions) {
  std::vector<SurfacePiece> pieces;
  for (const int region : regions)
    for (const SurfacePiece& piece : surface_of(model.definition, model.lattice.grid, region))
      if (holds(load.selection, model.definition, piece.at, region)) pieces.push_back(piece);
  return pieces;
}

Vec3 force_on(const SurfacePiece& piece, const LoadDefinition& load, double whole_area) {
  if (load.pressure) return -*load.pressure * piece.area;
  const double size = norm(piece.area);
  return load.traction ? size * *load.traction : (size / whole_area) * *load.force;
}

}  // namespace

std::vector<NodeForce> surface_forces(const Model& model, const LoadDefinition& load, const std::vector<int>& regions,
                                      const std::string& path, const std::string& title) {
  const auto pieces = selected_pieces(model, load, regions);
  if (pieces.empty())
    throw InputError(
        model.definition.places.find(path),
        fmt::format(
            "{} selects no surface of the body: on both sides of the surface it names lies the same, or it lies "
            "outside of what else the selection asks for",
            title));
  double whole_area = 0;
  for (const SurfacePiece& piece : pieces) whole_area += norm(piece.area);

  const lattice::Layout& layout = model.layout();
  const lattice::Grid& grid = model.lattice.grid;
  std::map<std::int64_t, Vec3> forces;
  for (const SurfacePiece& piece : pieces) {
    const Vec3 force = force_on(piece, load, whole_area);
    const Vec3 at = (1 / grid.d) * (piece.at - grid.position(piece.cell));
    for (int c = 0; c < 8; ++c) {
      double weight = 1;
      Int3 node = piece.cell;
      for (std::size_t a = 0; a < 3; ++a) {
        const bool upper = c >> a & 1;
        weight *= upper ? at[a] : 1 - at[a];
        node[a] += upper;
        if (grid.periodic[a]) node[a] %= grid.cells[a];
      }
      const Int3 local = layout.local(node);
      if (!layout.owns(local)) continue;
      Vec3& sum = forces[layout.index(local)];
      sum = sum + weight * force;
    }
  }
  std::vector<NodeForce> list;
  list.reserve(forces.size());
  for (const auto& [node, force] : forces) list.push_back({node, force});
  return list;
}

}  // namespace koshi::model
