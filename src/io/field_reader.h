// Reads back the fields that FieldWriter wrote (docs/formats/output.md).
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "io/vti_file.h"

namespace koshi::io {

/// A sample named by `fields.pvd`.
struct SampleFile {
  double time = 0;  ///< [s]
  std::filesystem::path path;
};

/// Samples of an output directory in the order of the collection; none without `fields.pvd`. Throws InputError when
/// that file cannot be read as a collection.
std::vector<SampleFile> list_samples(const std::filesystem::path& directory);

/// A field of a sample, without its values.
struct FieldInfo {
  std::string name;
  bool on_cells = false;
  std::vector<std::string> components;  ///< names; VTK's own ("0", "1", ...) where the file has none
};

/// One sample, whatever number of ranks wrote it. Points and cells have the indices of the whole grid, x fastest.
class FieldReader {
 public:
  /// Reads a `.vti` or `.pvti` file. Throws InputError when it cannot be read.
  explicit FieldReader(const std::filesystem::path& path);

  Int3 cells() const;
  Vec3 origin() const;  ///< lower corner [m]
  double spacing() const;
  std::vector<FieldInfo> fields() const;  ///< all but the material

  /// Material index of every cell, 0 = empty.
  std::span<const std::uint16_t> material() const { return material_; }

  /// Values of a field at points (or cells, for a field on cells): all components of the first, then of the second ...
  /// Throws InputError when the sample has no such field.
  std::vector<float> gather(const FieldInfo& field, std::span<const std::int64_t> indices) const;

 private:
  void open_whole();
  void open_pieces();
  void read_material();

  std::filesystem::path path_;
  std::vector<std::shared_ptr<VtiFile>> pieces_;  ///< one for a .vti file
  Extent extent_{};                               ///< of the whole
  Vec3 origin_{};
  double spacing_ = 0;
  std::vector<std::uint16_t> material_;
};

}  // namespace koshi::io
