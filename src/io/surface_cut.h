// Which parts of cells lie inside a closed surface.
#pragma once

#include <array>
#include <filesystem>
#include <vector>

#include "koshi/definition.h"
#include "koshi/grid.h"

namespace koshi::io {

/// The cells that the surface of an STL file cuts, by index, each with the plane below which just the volume lies that
/// is inside, its normal the mean one of the surface in the cell; `scale` [m] is the length of the file's unit.
/// Errors: InputError without a place for a file that cannot be read, a surface that is open, whose triangles do not
/// all face outwards (or all inwards), or that crosses or overlaps itself.
std::vector<model::CutCell> cells_cut(const std::filesystem::path& file, double scale, const lattice::Grid& grid);

/// Triangles [m] of the closed surface, counter-clockwise seen from outside. Errors: as above.
std::vector<std::array<Vec3, 3>> outward_triangles(const std::filesystem::path& file, double scale);

}  // namespace koshi::io
