#include "model/surface_loads.h"

#include <fmt/format.h>

#include <map>

#include "model/selection.h"
#include "model/triangle_points.h"

namespace koshi::model {
namespace {

Vec3 force_on(const SurfacePiece& piece, const LoadDefinition& load, double whole_area) {
  if (load.pressure) return -*load.pressure * piece.area;
  const double size = norm(piece.area);
  return load.traction ? size * *load.traction : (size / whole_area) * *load.force;
}

// Means of the corners' shape functions over a piece; at its middle alone they would leave forces that no stress takes.
std::array<CornerShare, 8> mean_shares(const lattice::Grid& grid, const SurfacePiece& piece) {
  std::array<CornerShare, 8> mean = corner_shares(grid, piece.cell, piece.at);
  for (CornerShare& share : mean) share.weight = 0;
  const double whole = 2 * norm(piece.area);
  for (std::size_t v = 2; v < piece.corners.size(); ++v) {
    const Vec3 &a = piece.corners[0], &b = piece.corners[v - 1], &c = piece.corners[v];
    const double part = norm(cross(b - a, c - a)) / whole;
    for_each_point(a, b, c, [&](const Vec3& place, double share) {
      const auto shares = corner_shares(grid, piece.cell, place);
      for (std::size_t corner = 0; corner < 8; ++corner) mean[corner].weight += part * share * shares[corner].weight;
    });
  }
  return mean;
}

}  // namespace

std::array<CornerShare, 8> corner_shares(const lattice::Grid& grid, const Int3& cell, const Vec3& place) {
  const Vec3 at = (1 / grid.d) * (place - grid.position(cell));
  std::array<CornerShare, 8> shares;
  for (std::size_t c = 0; c < 8; ++c) {
    CornerShare& share = shares[c];
    share = {cell, 1};
    for (std::size_t a = 0; a < 3; ++a) {
      const bool upper = c >> a & 1;
      share.weight *= upper ? at[a] : 1 - at[a];
      share.node[a] += upper;
      if (grid.periodic[a]) share.node[a] %= grid.cells[a];
    }
  }
  return shares;
}

std::vector<SurfacePiece> selected_pieces(const Model& model, const Selection& selection,
                                          const std::vector<int>& regions, const std::string& path,
                                          const std::string& title) {
  std::vector<SurfacePiece> pieces;
  for (const int region : regions)
    for (SurfacePiece& piece : surface_of(model.definition, model.lattice.grid, region))
      if (holds(selection, model.definition, piece.at, region)) pieces.push_back(std::move(piece));
  if (pieces.empty())
    throw InputError(
        model.definition.places.find(path),
        fmt::format(
            "{} selects no surface of the body: on both sides of the surface it names lies the same, or it lies "
            "outside of what else the selection asks for",
            title));
  return pieces;
}

std::vector<NodeForce> surface_forces(const Model& model, const LoadDefinition& load,
                                      const std::vector<SurfacePiece>& pieces) {
  double whole_area = 0;
  for (const SurfacePiece& piece : pieces) whole_area += norm(piece.area);
  const lattice::Layout& layout = model.layout();
  std::map<std::int64_t, Vec3> forces;
  for (const SurfacePiece& piece : pieces) {
    const Vec3 force = force_on(piece, load, whole_area);
    for (const CornerShare& share : mean_shares(model.lattice.grid, piece)) {
      const Int3 local = layout.local(share.node);
      if (!layout.owns(local)) continue;
      Vec3& sum = forces[layout.index(local)];
      sum = sum + share.weight * force;
    }
  }
  std::vector<NodeForce> list;
  list.reserve(forces.size());
  for (const auto& [node, force] : forces) list.push_back({node, force});
  return list;
}

}  // namespace koshi::model
