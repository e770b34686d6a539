// The surface of a voxel body as quadrilaterals, thinned where it is too large to look at.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "koshi/vector3.h"

namespace koshi::report {

struct SurfaceLimits {
  std::int64_t surface_points = 1'000'000;  ///< more than these are thinned
  std::int64_t interior_points = 0;         ///< a body of at most this many nodes keeps its inside
};

/// Nodes and cells are named by their place in the grid: i + (nx + 1)(j + (ny + 1) k) and i + nx (j + ny k).
struct Surface {
  std::vector<std::int64_t> points;                ///< node of each point
  std::vector<std::array<std::int32_t, 4>> quads;  ///< indices into `points`, counter-clockwise seen from outside
  std::vector<std::int32_t> quad_cell;             ///< index into `cells` of the cell behind each quad
  std::vector<std::int64_t> cells;                 ///< cells behind a quad; with the interior all solid cells
  bool has_interior = false;                       ///< `points` and `cells` hold the inside as well
  std::int64_t stride = 1;                         ///< cells per axis that one quad stands for
  std::int64_t body_points = 0;                    ///< points of the surface before thinning
};

/// Surface of the cells whose material is not 0; `material` has one byte per cell, x fastest.
/// Thinned, blocks of stride^3 cells with any solid cell count as solid, and a corner of a block becomes the node
/// nearest to it that touches a solid cell of the blocks around, so that every point shown is a node with its own
/// values.
Surface extract_surface(const Int3& cells, std::span<const std::uint16_t> material, const SurfaceLimits& limits);

}  // namespace koshi::report
