// Loads on the surfaces of regions.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "koshi/model.h"
#include "model/region_surface.h"

namespace koshi::model {

/// What a corner of a cell takes of a force inside it.
struct CornerShare {
  Int3 node{};        ///< global, within the period
  double weight = 0;  ///< shape function of the corner
};

/// The trilinear shares of a cell's corners in a force at a place [m].
std::array<CornerShare, 8> corner_shares(const lattice::Grid& grid, const Int3& cell, const Vec3& place);

/// What a selection holds of the surfaces of `regions`, in a fixed order, the same on any ranks. `path` and `title`
/// name what selects in messages; throws InputError when it selects no surface of the body.
std::vector<SurfacePiece> selected_pieces(const Model& model, const Selection& selection,
                                          const std::vector<int>& regions, const std::string& path,
                                          const std::string& title);

/// Forces of a pressure, traction or total force on pieces of surface: each gives its force to the corners of its cell
/// by the means of their trilinear shape functions over it, which keeps force and moment. Sorted by node; the same bits
/// on any ranks.
std::vector<NodeForce> surface_forces(const Model& model, const LoadDefinition& load,
                                      const std::vector<SurfacePiece>& pieces);

}  // namespace koshi::model
