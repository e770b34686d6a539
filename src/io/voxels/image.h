// A voxel image in memory: numbers of one type, as they come out of a file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/voxels/byte_source.h"
#include "koshi/vector3.h"

namespace koshi::io {

enum class ValueType { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

std::size_t size_of(ValueType type);  ///< [bytes]
const char* name_of(ValueType type);  ///< e.g. "uint8"
bool is_whole(ValueType type);        ///< no fractions

/// What the header of a file says of its values; the first axis runs fastest.
struct VoxelHeader {
  Int3 size{};  ///< voxels along the three axes
  ValueType type = ValueType::uint8;
  bool big_endian = false;
  std::optional<Vec3> voxel;  ///< sides of a voxel in the file's unit of length, where the file has them
};

/// Value n of the three axes lies at n_0 stride_0 + n_1 stride_1 + n_2 stride_2.
struct VoxelImage {
  Int3 size{};    ///< along x, y, z
  Int3 stride{};  ///< in values
  ValueType type = ValueType::uint8;
  std::vector<std::byte> bytes;  ///< the machine's order
  std::optional<Vec3> voxel;
};

/// "3 x 6 x 3 voxels of uint8", for messages.
std::string words_of(const VoxelHeader& header);

/// Bytes of all values. Errors: InputError without a place when an axis is empty or the number beyond any file's.
std::uint64_t bytes_of(const VoxelHeader& header);

/// The image whose values are all that is left in the source. Errors: InputError without a place.
VoxelImage read_values(const VoxelHeader& header, ByteSource& source);

/// Reverses the bytes of each value.
void swap_bytes(std::vector<std::byte>& values, std::size_t size);

/// Value at a place in memory; 64-bit whole numbers beyond 2^53 are rounded.
double value_at(const std::vector<std::byte>& values, ValueType type, std::size_t index);

}  // namespace koshi::io
