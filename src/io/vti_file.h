// VTK XML images (.vti), read without VTK: https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/input_file.h"
#include "io/voxels/image.h"
#include "io/xml.h"

namespace koshi::io {

/// An array of a VTK file, without its values.
struct VtiArray {
  std::string name;
  bool on_cells = false;          ///< or on points
  std::optional<ValueType> type;  ///< none: no numbers
  int components = 1;
  std::vector<std::string> component_names;  ///< "0", "1", ... where the file has none
  const XmlElement* element = nullptr;       ///< of the file
};

/// Points {x_lo, x_hi, y_lo, ...} of a grid, bounds included.
using Extent = std::array<std::int64_t, 6>;

/// "0 3 0 6 0 3" as an extent with at least one cell along each axis. Errors: InputError without a place.
Extent parse_extent(const std::string& text);

/// Three numbers. Errors: InputError without a place.
Vec3 parse_vector(const std::string& text, const Vec3& otherwise);

class VtiFile {
 public:
  /// Reads all but the values. Errors: InputError without a place: no VTK image, or one whose pieces do not cover its
  /// extent.
  explicit VtiFile(const std::filesystem::path& path);

  const Extent& extent() const { return extent_; }
  Int3 cells() const;
  const Vec3& origin() const { return origin_; }
  const Vec3& spacing() const { return spacing_; }
  const std::vector<VtiArray>& arrays() const { return arrays_; }

  /// Values of an array, components fastest. Errors: InputError without a place: more or fewer than the extent asks
  /// for, damaged, or no numbers.
  std::vector<std::byte> values(const VtiArray& array) const;

 private:
  InputFile file_;
  XmlElement root_;
  Extent extent_{};
  Vec3 origin_{}, spacing_{};
  std::vector<VtiArray> arrays_;
  std::uint64_t data_begin_ = 0, data_end_ = 0;  ///< of the appended section
  bool encoded_ = false;                         ///< the appended section is base64
  std::vector<std::uint64_t> offsets_;           ///< of all arrays in that section, ascending
};

}  // namespace koshi::io
