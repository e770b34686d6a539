// Triangles of an STL file, binary or text.
#pragma once

#include <array>
#include <filesystem>
#include <vector>

#include "koshi/vector3.h"

namespace koshi::io {

/// Corners in the file's unit, in the file's order; triangles that are a line or a point are left out. Errors:
/// InputError without a place.
std::vector<std::array<Vec3, 3>> read_stl(const std::filesystem::path& path);

}  // namespace koshi::io
