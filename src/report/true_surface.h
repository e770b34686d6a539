// The true surface of a body whose cells are cut: where the points of the surface of its cells lie on it.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "koshi/definition.h"
#include "koshi/grid.h"
#include "report/surface.h"

namespace koshi::report {

/// A point of the surface of cells, put onto the true surface.
struct MovedPoint {
  std::int32_t point = 0;               ///< index into Surface::points
  Vec3 at{};                            ///< where it lies on the true surface [m]
  std::array<std::int64_t, 8> nodes{};  ///< corners of the solid cell there, named as Surface::points are
  std::array<float, 8> weights{};       ///< their trilinear shape functions at that place
};

/// Points of the surface of a body that its regions cut, but for those that stay where they are: each goes to the
/// nearest place of the surfaces of the regions that is surface of the body; on the border of the grid, where the body
/// fills part of the border, within it. Points more than two cells from any of these surfaces stay. The definition
/// must hold the contents of its files, and the triangles of every region from a file.
std::vector<MovedPoint> true_surface(const model::Definition& definition, const lattice::Grid& grid,
                                     const Surface& surface);

}  // namespace koshi::report
