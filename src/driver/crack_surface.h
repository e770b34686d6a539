// The surface of the cracks in a body, a polygon for each cell that has cracked through.
#pragma once

#include <span>
#include <vector>

#include "driver/cracked_cells.h"

namespace koshi::driver {

/// The part of the plane of normal n through the centre of a cell of side d that lies in the cell: three to six corners
/// in order around it.
std::vector<Vec3> cut_of_cell(const Vec3& centre, double d, const Vec3& n);

/// The cut of each cell by its crack, in the order of the cells.
std::vector<std::vector<Vec3>> crack_surface(const lattice::Grid& grid, std::span<const CrackedCell> cells);

}  // namespace koshi::driver
