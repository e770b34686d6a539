// What lies where in a checkpoint: a text that the seal points to, read by this code alone. HDF5 writes the file, so
// that other programs can open it, and trusts what it reads: a file made to break it would reach its structures.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

namespace koshi::io {

// Fields that every checkpoint has.
inline constexpr const char* displacement_name = "displacement";
inline constexpr const char* velocity_name = "velocity";

/// A part of a file.
struct Bytes {
  std::uint64_t offset = 0, count = 0;  ///< from the file's first byte
};

/// Values of 64-bit floating point, little-endian.
struct IndexedField {
  std::uint64_t offset = 0;
  std::array<std::int64_t, 4> shape{};  ///< components, nz, ny, nx
};

struct CheckpointIndex {
  double time = 0;  ///< [s]
  std::int64_t step = 0;
  Bytes case_text, blob;
  std::map<std::string, double> scalars;
  std::map<std::string, IndexedField> fields;
};

std::string text_of(const CheckpointIndex& index);

/// The index of a file of this size. Errors: InputError without a place or file, when it is no index, or names places
/// behind the end of the file or in its seal, or a time or step that is negative or no number.
CheckpointIndex parse_index(std::string_view text, std::uint64_t file_size);

}  // namespace koshi::io
