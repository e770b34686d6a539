// Polygons in space as a VTK file.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "koshi/vector3.h"

namespace koshi::io {

/// Values of the polygons by name, as many each as there are times more of them than polygons.
using PolygonValues = std::vector<std::pair<std::string, std::vector<double>>>;

/// Writes `path` (.vtp): polygons by their corners, with values. Written beside, then renamed. Throws RunError with the
/// system's reason.
void write_polygons(const std::filesystem::path& path, std::span<const std::vector<Vec3>> polygons,
                    const PolygonValues& values);

}  // namespace koshi::io
