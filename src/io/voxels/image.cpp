#include "io/voxels/image.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include "koshi/error.h"

namespace koshi::io {
namespace {

struct Kind {
  const char* name;
  std::size_t size;
  bool whole;
};

// In the order of ValueType.
constexpr Kind kinds[] = {{"int8", 1, true},     {"uint8", 1, true},   {"int16", 2, true}, {"uint16", 2, true},
                          {"int32", 4, true},    {"uint32", 4, true},  {"int64", 8, true}, {"uint64", 8, true},
                          {"float32", 4, false}, {"float64", 8, false}};

const Kind& kind_of(ValueType type) { return kinds[static_cast<std::size_t>(type)]; }

template <class T>
double load(const std::vector<std::byte>& values, std::size_t index) {
  T value;
  std::memcpy(&value, values.data() + index * sizeof value, sizeof value);
  return static_cast<double>(value);
}

}  // namespace

std::size_t size_of(ValueType type) { return kind_of(type).size; }
const char* name_of(ValueType type) { return kind_of(type).name; }
bool is_whole(ValueType type) { return kind_of(type).whole; }

std::string words_of(const VoxelHeader& header) {
  return fmt::format("{} x {} x {} voxels of {}", header.size[0], header.size[1], header.size[2], name_of(header.type));
}

std::uint64_t bytes_of(const VoxelHeader& header) {
  std::uint64_t bytes = size_of(header.type);
  constexpr std::uint64_t most = std::uint64_t{1} << 50;
  for (const std::int64_t n : header.size) {
    if (n <= 0) throw InputError(fmt::format("has {} and hence no cells", words_of(header)));
    if (static_cast<std::uint64_t>(n) > most / bytes)
      throw InputError(fmt::format("has {}, more than any file can hold", words_of(header)));
    bytes *= static_cast<std::uint64_t>(n);
  }
  return bytes;
}

VoxelImage read_values(const VoxelHeader& header, ByteSource& source) {
  VoxelImage image{header.size, {}, header.type, {}, header.voxel};
  image.bytes = source.read_rest(bytes_of(header), words_of(header));
  // Only now, when the values are there, is their number known to be one that an integer holds.
  image.stride = {1, header.size[0], header.size[0] * header.size[1]};
  if (header.big_endian != (std::endian::native == std::endian::big)) swap_bytes(image.bytes, size_of(header.type));
  return image;
}

void swap_bytes(std::vector<std::byte>& values, std::size_t size) {
  if (size == 1) return;
  for (auto at = values.begin(); at != values.end(); at += static_cast<std::ptrdiff_t>(size))
    std::reverse(at, at + static_cast<std::ptrdiff_t>(size));
}

double value_at(const std::vector<std::byte>& values, ValueType type, std::size_t index) {
  switch (type) {
    case ValueType::int8:
      return load<std::int8_t>(values, index);
    case ValueType::uint8:
      return load<std::uint8_t>(values, index);
    case ValueType::int16:
      return load<std::int16_t>(values, index);
    case ValueType::uint16:
      return load<std::uint16_t>(values, index);
    case ValueType::int32:
      return load<std::int32_t>(values, index);
    case ValueType::uint32:
      return load<std::uint32_t>(values, index);
    case ValueType::int64:
      return load<std::int64_t>(values, index);
    case ValueType::uint64:
      return load<std::uint64_t>(values, index);
    case ValueType::float32:
      return load<float>(values, index);
    case ValueType::float64:
      return load<double>(values, index);
  }
  return 0;
}

}  // namespace koshi::io
