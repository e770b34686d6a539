// NRRD: a line with the version, lines "field: value" up to an empty one, then the values, here or in another file.
// https://teem.sourceforge.net/nrrd/format.html
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "base/escape.h"
#include "io/voxels/formats.h"
#include "io/voxels/header_text.h"
#include "koshi/error.h"

namespace koshi::io {
namespace {

using Fields = std::map<std::string, std::string>;

struct Nrrd {
  VoxelHeader header;
  std::uint64_t data = 0;    ///< offset of values in the same file
  std::int64_t skipped = 0;  ///< bytes before the values; -1: all that are too many
  Compression compression = Compression::none;
  std::string file;  ///< of the values; empty: this
};

constexpr std::array known{"axis maxs",
                           "axis mins",
                           "block size",
                           "blocksize",
                           "byte skip",
                           "byteskip",
                           "centerings",
                           "centers",
                           "content",
                           "data file",
                           "datafile",
                           "dimension",
                           "encoding",
                           "endian",
                           "kinds",
                           "labels",
                           "line skip",
                           "lineskip",
                           "max",
                           "measurement frame",
                           "min",
                           "number",
                           "old max",
                           "old min",
                           "oldmax",
                           "oldmin",
                           "sample units",
                           "sampleunits",
                           "sizes",
                           "space",
                           "space dimension",
                           "space directions",
                           "space origin",
                           "space units",
                           "spacings",
                           "thicknesses",
                           "type",
                           "units",
                           "axismaxs",
                           "axismins"};

// An empty line ends the header; in a header with a data file of its own the end of the file does, too.
Fields read_fields(const InputFile& file, std::uint64_t& end) {
  HeaderLines lines(file);
  const std::string magic = file.text(0, 8);
  if (!magic.starts_with("NRRD000") || magic.size() < 8 || magic[7] < '1' || magic[7] > '5')
    throw InputError("is not an NRRD image");
  lines.next();
  Fields fields;
  bool ended = false;
  while (const auto line = lines.next()) {
    end = lines.offset();
    if ((ended = line->empty())) break;
    if (line->starts_with('#')) continue;
    const std::size_t colon = line->find(':');
    const bool pair = colon != std::string::npos && line->substr(colon, 2) == ":=";
    if (pair) continue;  // of a program's own
    const std::string name = line->substr(0, std::min(colon, line->size()));
    if (colon == std::string::npos || std::find(known.begin(), known.end(), name) == known.end())
      throw InputError(
          fmt::format("has {} in line {} of its header; expected a field of the NRRD format such as "
                      "\"sizes: 4 3 2\"",
                      shown(*line), lines.number()));
    if (!fields.emplace(name, trimmed(std::string_view(*line).substr(colon + 1))).second)
      throw InputError(fmt::format("has the field \"{}\" twice", name));
  }
  const bool detached = fields.contains("data file") || fields.contains("datafile");
  if (!ended && !detached) throw InputError("has an NRRD header that does not end; an empty line must follow it");
  return fields;
}

// The field of this name, under its other spelling without a blank, too.
std::string value_of(const Fields& fields, std::string name) {
  auto at = fields.find(name);
  if (at == fields.end()) {
    std::erase(name, ' ');
    at = fields.find(name);
  }
  return at == fields.end() ? "" : at->second;
}

InputError wrong(const Fields& fields, const std::string& name, const std::string& expected) {
  const std::string value = value_of(fields, name);
  if (value.empty()) return InputError(fmt::format("has no field \"{}\"; expected {}", name, expected));
  return InputError(fmt::format("has {}: {}; expected {}", name, shown(value), expected));
}

// An axis of one value beside the three of space counts as none; a missing third axis as one of one voxel.
Int3 read_size(const Fields& fields, std::vector<std::size_t>& axes) {
  const auto dimension = whole_number(value_of(fields, "dimension"));
  if (!dimension || *dimension < 2 || *dimension > 4) throw wrong(fields, "dimension", "3 (or 2)");
  const std::string text = value_of(fields, "sizes");
  const auto parts = words(text);
  if (parts.size() != static_cast<std::size_t>(*dimension))
    throw wrong(fields, "sizes", fmt::format("{} numbers", *dimension));
  std::vector<std::int64_t> sizes;
  for (const std::string_view part : parts) {
    const auto n = whole_number(part);
    if (!n || *n <= 0) throw wrong(fields, "sizes", "positive whole numbers");
    sizes.push_back(*n);
  }
  for (std::size_t a = 0; a < sizes.size(); ++a)
    if (sizes.size() <= 3 || sizes[a] != 1 || axes.size() + (sizes.size() - a) <= 3) axes.push_back(a);
  if (axes.size() > 3) throw wrong(fields, "sizes", "three axes, one value a voxel");
  Int3 size{1, 1, 1};
  for (std::size_t a = 0; a < axes.size(); ++a) size[a] = sizes[axes[a]];
  const std::string said = value_of(fields, "kinds");
  const auto kinds = words(said);
  for (std::size_t a = 0; a < axes.size() && kinds.size() == sizes.size(); ++a)
    if (const auto kind = kinds[axes[a]]; kind != "domain" && kind != "space" && kind != "none" && kind != "???" &&
                                          kind != "scalar" && kind != "stub" && sizes[axes[a]] != 1)
      throw wrong(fields, "kinds", "domain or space; one value a voxel");
  return size;
}

ValueType read_type(const Fields& fields) {
  using enum ValueType;
  static const std::map<std::string, ValueType> types{{"signed char", int8},
                                                      {"int8", int8},
                                                      {"int8_t", int8},
                                                      {"uchar", uint8},
                                                      {"unsigned char", uint8},
                                                      {"uint8", uint8},
                                                      {"uint8_t", uint8},
                                                      {"short", int16},
                                                      {"short int", int16},
                                                      {"signed short", int16},
                                                      {"signed short int", int16},
                                                      {"int16", int16},
                                                      {"int16_t", int16},
                                                      {"ushort", uint16},
                                                      {"unsigned short", uint16},
                                                      {"unsigned short int", uint16},
                                                      {"uint16", uint16},
                                                      {"uint16_t", uint16},
                                                      {"int", int32},
                                                      {"signed int", int32},
                                                      {"int32", int32},
                                                      {"int32_t", int32},
                                                      {"uint", uint32},
                                                      {"unsigned int", uint32},
                                                      {"uint32", uint32},
                                                      {"uint32_t", uint32},
                                                      {"longlong", int64},
                                                      {"long long", int64},
                                                      {"long long int", int64},
                                                      {"signed long long", int64},
                                                      {"signed long long int", int64},
                                                      {"int64", int64},
                                                      {"int64_t", int64},
                                                      {"ulonglong", uint64},
                                                      {"unsigned long long", uint64},
                                                      {"unsigned long long int", uint64},
                                                      {"uint64", uint64},
                                                      {"uint64_t", uint64},
                                                      {"float", float32},
                                                      {"double", float64}};
  const auto at = types.find(value_of(fields, "type"));
  if (at == types.end()) throw wrong(fields, "type", "a number such as uint8, int16 or float");
  return at->second;
}

// Sides of a voxel: "spacings: 1 1 2", or the lengths of "space directions: (1,0,0) (0,1,0) (0,0,2)".
std::optional<Vec3> read_voxel(const Fields& fields, const std::vector<std::size_t>& axes) {
  const std::string spacings = value_of(fields, "spacings"), directions = value_of(fields, "space directions");
  const auto parts = words(spacings.empty() ? directions : spacings);
  if (axes.size() != 3 || parts.size() <= axes.back()) return std::nullopt;
  Vec3 voxel{};
  for (std::size_t a = 0; a < 3; ++a) {
    std::string text(parts[axes[a]]);
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c == '(' || c == ')' || c == ','; }, ' ');
    double square = 0;
    for (const std::string_view component : words(text)) {
      const auto x = real_number(component);
      if (!x) return std::nullopt;
      square += *x * *x;
    }
    voxel[a] = std::sqrt(square);
  }
  return voxel;
}

Nrrd read_header(const InputFile& file) {
  Nrrd nrrd;
  const Fields fields = read_fields(file, nrrd.data);
  std::vector<std::size_t> axes;
  nrrd.header.size = read_size(fields, axes);
  nrrd.header.type = read_type(fields);
  nrrd.header.voxel = read_voxel(fields, axes);

  const std::string encoding = value_of(fields, "encoding");
  if (encoding == "gzip" || encoding == "gz")
    nrrd.compression = Compression::zlib;
  else if (encoding == "bzip2" || encoding == "bz2")
    nrrd.compression = Compression::bzip2;
  else if (encoding != "raw")
    throw wrong(fields, "encoding", "\"raw\", \"gzip\" or \"bzip2\"; save it as one of them");

  const std::string endian = value_of(fields, "endian");
  if (endian != "little" && endian != "big" && (!endian.empty() || size_of(nrrd.header.type) > 1))
    throw wrong(fields, "endian", "\"little\" or \"big\"");
  nrrd.header.big_endian = endian == "big";

  const auto skip = [&](const char* name) {
    const std::string text = value_of(fields, name);
    const auto count = whole_number(text.empty() ? "0" : text);
    if (!count || *count < -1) throw wrong(fields, name, "a whole number");
    return *count;
  };
  if (skip("line skip") != 0) throw wrong(fields, "line skip", "none");
  nrrd.skipped = skip("byte skip");
  if (nrrd.skipped != 0 && nrrd.compression != Compression::none)
    throw wrong(fields, "byte skip", "none with compressed values");

  nrrd.file = value_of(fields, "data file");
  if (nrrd.file.starts_with("LIST") || nrrd.file.find('%') != std::string::npos)
    throw InputError("names one file for each slice; join the slices to one file");
  return nrrd;
}

VoxelImage read_values_of(const Nrrd& nrrd, const InputFile& file, std::uint64_t begin) {
  const std::uint64_t bytes = bytes_of(nrrd.header);
  if (nrrd.skipped >= 0)
    begin += static_cast<std::uint64_t>(nrrd.skipped);
  else if (file.size() > bytes)
    begin = std::max(begin, file.size() - bytes);
  ByteSource source(file, begin, file.size(), nrrd.compression);
  return read_values(nrrd.header, source);
}

}  // namespace

VoxelImage read_nrrd(const std::filesystem::path& path) {
  const InputFile file(path);
  const Nrrd nrrd = read_header(file);
  if (nrrd.file.empty()) return read_values_of(nrrd, file, nrrd.data);
  return read_beside(path, nrrd.file, [&](const InputFile& data) { return read_values_of(nrrd, data, 0); });
}

}  // namespace koshi::io
