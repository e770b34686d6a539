// NIfTI-1 (.nii, .nii.gz): a header of 348 bytes in either byte order, extensions, the values.
// https://nifti.nimh.nih.gov/pub/dist/src/niftilib/nifti1.h
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <map>

#include "io/voxels/formats.h"
#include "koshi/error.h"

namespace koshi::io {
namespace {

constexpr std::size_t header_size = 348;

/// The fields of a header at their places.
class Fields {
 public:
  explicit Fields(ByteSource& source) {
    std::vector<std::byte> start(bytes_.size());
    if (source.read(start) != start.size()) throw InputError("is no NIfTI image: it is shorter than a header");
    std::copy(start.begin(), start.end(), bytes_.begin());
    swapped_ = get<std::int32_t>(0) != header_size;
    const std::int32_t size = get<std::int32_t>(0);
    if (size == 540) throw InputError("is a NIfTI-2 image; save it as NIfTI-1");
    if (size != header_size || std::memcmp(bytes_.data() + 344, "n+1", 4) != 0)
      throw InputError("is no NIfTI-1 image of one file");
  }
  template <class T>
  T get(std::size_t offset) const {
    std::array<std::byte, sizeof(T)> raw;
    std::memcpy(raw.data(), bytes_.data() + offset, raw.size());
    if (swapped_) std::reverse(raw.begin(), raw.end());
    return std::bit_cast<T>(raw);
  }
  bool swapped() const { return swapped_; }

 private:
  std::array<std::byte, header_size> bytes_{};
  bool swapped_ = false;
};

VoxelHeader read_header(const Fields& fields) {
  using enum ValueType;
  static const std::map<int, ValueType> types{{2, uint8},  {4, int16},    {8, int32},    {16, float32}, {64, float64},
                                              {256, int8}, {512, uint16}, {768, uint32}, {1024, int64}, {1280, uint64}};
  VoxelHeader header;
  header.big_endian = fields.swapped() == (std::endian::native == std::endian::little);
  const int code = fields.get<std::int16_t>(70);
  const auto type = types.find(code);
  if (type == types.end()) throw InputError(fmt::format("holds values of NIfTI's type {}, no numbers", code));
  header.type = type->second;

  // dim[0] is the number of axes; those beyond the third must be of one value.
  const int axes = fields.get<std::int16_t>(40);
  if (axes < 2 || axes > 7) throw InputError(fmt::format("has {} axes; expected three", axes));
  header.size = {1, 1, 1};
  Vec3 voxel{1, 1, 1};
  for (int a = 0; a < axes; ++a) {
    const int n = fields.get<std::int16_t>(42 + 2 * static_cast<std::size_t>(a));
    if (a >= 3 && n != 1)
      throw InputError(fmt::format("has {} values along its axis {}; expected three axes", n, a + 1));
    if (a >= 3) continue;
    header.size[static_cast<std::size_t>(a)] = n;
    voxel[static_cast<std::size_t>(a)] = std::abs(fields.get<float>(80 + 4 * static_cast<std::size_t>(a)));
  }
  if (axes >= 3) header.voxel = voxel;
  const float slope = fields.get<float>(112), shift = fields.get<float>(116);
  if (slope != 0 && (slope != 1 || shift != 0))
    throw InputError(
        fmt::format("has values that are to be scaled by {} and shifted by {}; save the scaled ones", slope, shift));
  return header;
}

}  // namespace

VoxelImage read_nifti(const std::filesystem::path& path) {
  const InputFile file(path);
  const std::string magic = file.text(0, 2);
  const bool gzip = magic == "\x1f\x8b";
  ByteSource source(file, 0, file.size(), gzip ? Compression::zlib : Compression::none);
  const Fields fields(source);
  const VoxelHeader header = read_header(fields);

  // Between header and values lie extensions of other programs.
  const float offset = fields.get<float>(108);
  if (!(offset >= header_size) || offset > (1 << 24))
    throw InputError(fmt::format("has values at byte {}; expected 352 or a little more", offset));
  std::vector<std::byte> between(static_cast<std::size_t>(offset) - header_size);
  if (source.read(between) != between.size()) throw InputError("is cut short before its values");
  return read_values(header, source);
}

}  // namespace koshi::io
