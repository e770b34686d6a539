// MetaImage: lines "Key = Value" up to ElementDataFile, then the values, here or in another file.
// https://itk.org/Wiki/ITK/MetaIO/Documentation
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/escape.h"
#include "io/voxels/formats.h"
#include "io/voxels/header_text.h"
#include "koshi/error.h"

namespace koshi::io {
namespace {

using Keys = std::map<std::string, std::string>;

struct Meta {
  VoxelHeader header;
  std::uint64_t data = 0;              ///< offset of values in the same file
  std::int64_t skipped = 0;            ///< bytes before the values of a data file; -1: all that are too many
  std::optional<std::int64_t> packed;  ///< bytes of compressed values, where said
  Compression compression = Compression::none;
  std::string file;  ///< of the values; LOCAL: this
};

// Keys may be anything, since programs add their own; those that are known are looked at.
Keys read_keys(const InputFile& file, std::uint64_t& end) {
  HeaderLines lines(file);
  Keys keys;
  while (const auto line = lines.next()) {
    const std::size_t equals = line->find('=');
    if (equals == std::string::npos) {
      if (trimmed(*line).empty()) continue;
      throw InputError(lines.number() == 1 ? "is not a MetaImage"
                                           : fmt::format("has {} in line {} of its header; expected \"Key = Value\"",
                                                         shown(*line), lines.number()));
    }
    const std::string key(trimmed(std::string_view(*line).substr(0, equals)));
    if (!keys.emplace(key, trimmed(std::string_view(*line).substr(equals + 1))).second)
      throw InputError(fmt::format("has the key {} twice", shown(key)));
    end = lines.offset();
    if (key == "ElementDataFile") return keys;
  }
  throw InputError("is a MetaImage without ElementDataFile");
}

std::string value_of(const Keys& keys, const std::string& key) {
  const auto at = keys.find(key);
  return at == keys.end() ? "" : at->second;
}

InputError wrong(const Keys& keys, const std::string& key, const std::string& expected) {
  return InputError(fmt::format("has {} = {}; expected {}", key, shown(value_of(keys, key)), expected));
}

bool flag(const Keys& keys, const std::string& key, bool otherwise) {
  const std::string value = value_of(keys, key);
  if (value.empty()) return otherwise;
  if (value == "True" || value == "true" || value == "1") return true;
  if (value == "False" || value == "false" || value == "0") return false;
  throw wrong(keys, key, "True or False");
}

std::optional<std::int64_t> integer(const Keys& keys, const std::string& key) {
  if (!keys.contains(key)) return std::nullopt;
  const auto value = whole_number(value_of(keys, key));
  if (!value) throw wrong(keys, key, "a whole number");
  return value;
}

// Axes of an image of two dimensions get a third of one voxel.
Int3 read_size(const Keys& keys) {
  const std::int64_t axes = integer(keys, "NDims").value_or(3);
  if (axes != 2 && axes != 3) throw wrong(keys, "NDims", "3 (or 2)");
  if (!keys.contains("DimSize")) throw InputError("is a MetaImage without DimSize");
  const auto parts = words(keys.at("DimSize"));
  Int3 size{1, 1, 1};
  if (parts.size() != static_cast<std::size_t>(axes)) throw wrong(keys, "DimSize", fmt::format("{} numbers", axes));
  for (std::size_t a = 0; a < parts.size(); ++a) {
    const auto n = whole_number(parts[a]);
    if (!n || *n <= 0) throw wrong(keys, "DimSize", "positive whole numbers");
    size[a] = *n;
  }
  return size;
}

ValueType read_type(const Keys& keys) {
  // MET_LONG has the four bytes that the format gives it, whatever the machine's long has.
  static const std::map<std::string, ValueType> types{
      {"MET_CHAR", ValueType::int8},         {"MET_UCHAR", ValueType::uint8},   {"MET_SHORT", ValueType::int16},
      {"MET_USHORT", ValueType::uint16},     {"MET_INT", ValueType::int32},     {"MET_UINT", ValueType::uint32},
      {"MET_LONG", ValueType::int32},        {"MET_ULONG", ValueType::uint32},  {"MET_LONG_LONG", ValueType::int64},
      {"MET_ULONG_LONG", ValueType::uint64}, {"MET_FLOAT", ValueType::float32}, {"MET_DOUBLE", ValueType::float64}};
  const auto at = types.find(value_of(keys, "ElementType"));
  if (at == types.end())
    throw wrong(keys, "ElementType", "MET_UCHAR, MET_SHORT, MET_USHORT, MET_INT, MET_FLOAT or such");
  return at->second;
}

std::optional<Vec3> read_voxel(const Keys& keys) {
  const char* key = keys.contains("ElementSpacing") ? "ElementSpacing" : "ElementSize";
  const std::string text = value_of(keys, key);
  const auto parts = words(text);
  if (parts.size() != 3) return std::nullopt;
  Vec3 voxel{};
  for (std::size_t a = 0; a < 3; ++a) {
    const auto side = real_number(parts[a]);
    if (!side) throw wrong(keys, key, "three numbers");
    voxel[a] = *side;
  }
  return voxel;
}

Meta read_meta(const InputFile& file) {
  Meta meta;
  const Keys keys = read_keys(file, meta.data);
  if (keys.contains("ObjectType") && keys.at("ObjectType") != "Image") throw wrong(keys, "ObjectType", "Image");
  meta.header.size = read_size(keys);
  meta.header.type = read_type(keys);
  meta.header.voxel = read_voxel(keys);
  if (integer(keys, "ElementNumberOfChannels").value_or(1) != 1)
    throw wrong(keys, "ElementNumberOfChannels", "one value a voxel");
  if (!flag(keys, "BinaryData", true)) throw wrong(keys, "BinaryData", "True; save it as binary data");
  meta.header.big_endian = flag(keys, "BinaryDataByteOrderMSB", flag(keys, "ElementByteOrderMSB", false));
  if (flag(keys, "CompressedData", false)) meta.compression = Compression::zlib;
  meta.packed = integer(keys, "CompressedDataSize");
  meta.skipped = integer(keys, "HeaderSize").value_or(0);
  if (meta.skipped < -1) throw wrong(keys, "HeaderSize", "a number of bytes, or -1");
  meta.file = keys.at("ElementDataFile");
  if (meta.file == "LIST" || meta.file.starts_with("LIST ") || meta.file.find('%') != std::string::npos)
    throw InputError("names one file for each slice; join the slices to one file");
  if (meta.file.empty()) throw wrong(keys, "ElementDataFile", "LOCAL or the name of a file");
  return meta;
}

VoxelImage read_values_of(const Meta& meta, const InputFile& file, std::uint64_t begin) {
  if (meta.packed && meta.compression != Compression::none &&
      begin + static_cast<std::uint64_t>(std::max<std::int64_t>(*meta.packed, 0)) != file.size())
    throw InputError(fmt::format("has {} bytes of compressed values, but its header asks for {}", file.size() - begin,
                                 *meta.packed));
  ByteSource source(file, begin, file.size(), meta.compression);
  return read_values(meta.header, source);
}

}  // namespace

VoxelImage read_beside(const std::filesystem::path& header, std::string_view name,
                       const std::function<VoxelImage(const InputFile&)>& read) {
  try {
    return read(InputFile(header.parent_path() / name));
  } catch (const InputError& error) {
    throw InputError(fmt::format("names the data file {}, which {}", shown(name), error.message()));
  }
}

VoxelImage read_metaimage(const std::filesystem::path& path) {
  const InputFile file(path);
  const Meta meta = read_meta(file);
  if (meta.file == "LOCAL" || meta.file == "Local" || meta.file == "local")
    return read_values_of(meta, file, meta.data);
  const std::uint64_t bytes = bytes_of(meta.header);
  return read_beside(path, meta.file, [&](const InputFile& data) {
    std::uint64_t begin = static_cast<std::uint64_t>(meta.skipped);
    if (meta.skipped < 0) begin = data.size() > bytes ? data.size() - bytes : 0;
    if (begin > data.size()) throw InputError(fmt::format("has {} bytes, fewer than HeaderSize", data.size()));
    return read_values_of(meta, data, begin);
  });
}

}  // namespace koshi::io
