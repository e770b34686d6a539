// How the values of an image become cells.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "koshi/vector3.h"

namespace koshi::model {

/// [body.scan]
struct ScanDefinition {
  /// Of the values of a raw file.
  enum class Type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
  /// Of the values of a raw file: least or most significant byte first.
  enum class ByteOrder { little, big };

  std::optional<Vec3> size;                  ///< raw file: voxels along its axes, the first runs fastest
  Type type = Type::uint8;                   ///< raw file
  ByteOrder byte_order = ByteOrder::little;  ///< raw file
  int offset = 0;                            ///< raw file: bytes before the values
  std::optional<double> unit;  ///< length of the unit [m] in which the file gives the sides of its voxels, of which the
                               ///< spacing is made; unset: the spacing is given
  std::optional<std::pair<Vec3, Vec3>>
      crop;                       ///< {min, max}: voxels min <= n < max along the axes of the image are kept
  std::vector<std::string> axes;  ///< the axes of the image, "-" for backwards, that become x, y, z; empty: as they are
  int coarsen = 1;                ///< voxels along the edge of a cell
  std::vector<double> thresholds;  ///< ascending; a voxel's value is then the number of thresholds that it reaches
  /// Ascending grey values at which `density` is known; linear between, constant beyond. Instead of materials.
  std::vector<double> grey;
  std::vector<double> density;  ///< [kg/m^3] at these grey values, at most the material's; 0: void
  double exponent = 1;          ///< E = E of the material (density / its density)^exponent

  bool operator==(const ScanDefinition&) const = default;  ///< member by member
};

}  // namespace koshi::model
