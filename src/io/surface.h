// Closed surfaces as regions of cells.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "koshi/grid.h"

namespace koshi::io {

/// 1 for each cell, x fastest, whose centre lies inside the closed surface of an STL file: where the surface winds
/// around it, so that parts which overlap are united; `scale` [m] is the length of the file's unit. A centre on the
/// surface is inside where the body lies on the side of greater coordinates. What is notable goes to the log. Errors:
/// InputError without a place for a file that cannot be read, an open surface, a surface that holds no centre.
std::vector<std::uint8_t> cells_inside(const std::filesystem::path& file, double scale, const lattice::Grid& grid);

}  // namespace koshi::io
