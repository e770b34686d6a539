// Surfaces of regions as small flat pieces, each in one cell of the body.
#pragma once

#include <vector>

#include "koshi/definition.h"
#include "koshi/grid.h"
#include "model/clip.h"

namespace koshi::model {

/// A flat piece of a region's surface that is surface of the body.
struct SurfacePiece {
  Int3 cell{};        ///< the solid cell that feels it: the one it lies in, or if that is empty one close by
  Vec3 at{};          ///< its centroid [m]
  Vec3 area{};        ///< area times the normal that points out of the body [m^2]
  Polygon corners{};  ///< in order [m]
  int region = 0;     ///< whose surface it is
};

/// Where another surface ends one: between two pieces, or for pictures within a sixteenth of a cell.
enum class SurfaceEdges { pieces, fine };

/// The part of a region's surface with the body on one side only, in a fixed order, the same on every rank: triangles
/// with their corners on the true surface, cut along the planes between cells. Errors: InputError with the place of a
/// piece that is far from any solid cell; with fine edges such pieces are left out.
std::vector<SurfacePiece> surface_of(const Definition& definition, const lattice::Grid& grid, int region,
                                     SurfaceEdges edges = SurfaceEdges::pieces);

}  // namespace koshi::model
