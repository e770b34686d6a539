#include "io/vti_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "base/escape.h"
#include "io/voxels/header_text.h"
#include "io/vti_values.h"
#include "koshi/error.h"

namespace koshi::io {
namespace {

constexpr std::string_view appended_tag = "<AppendedData";

// Where a text first stands in the file at or behind `from`; the file's length if nowhere.
std::uint64_t find(const InputFile& file, std::string_view wanted, std::uint64_t from) {
  constexpr std::uint64_t step = 1 << 20;
  for (std::uint64_t at = from; at < file.size(); at += step)
    if (const std::size_t hit = file.text(at, at + step + wanted.size()).find(wanted); hit != std::string::npos)
      return at + hit;
  return file.size();
}

std::vector<std::string_view> numbers(std::string& text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return words(text);
}

std::optional<ValueType> type_of(const std::string& name) {
  constexpr std::array names{"Int8",   "UInt8", "Int16",  "UInt16",  "Int32",
                             "UInt32", "Int64", "UInt64", "Float32", "Float64"};  // in the order of ValueType
  const auto at = std::find(names.begin(), names.end(), name);
  if (at == names.end()) return std::nullopt;
  return static_cast<ValueType>(at - names.begin());
}

std::int64_t integer(const XmlElement& element, const std::string& key, std::int64_t otherwise) {
  const std::string text = element.attribute(key);
  if (text.empty()) return otherwise;
  const auto value = whole_number(text);
  if (!value || *value < 0) throw InputError(fmt::format("has {} = {} of a {}", key, shown(text), shown(element.name)));
  return *value;
}

VtiArray array_of(const XmlElement& element, bool on_cells) {
  VtiArray array{element.attribute("Name"), on_cells, type_of(element.attribute("type")), 1, {}, &element};
  const std::int64_t components = integer(element, "NumberOfComponents", 1);
  if (components < 1 || components > 64)
    throw InputError(fmt::format("has an array of {} components; expected 1 to 64", components));
  array.components = static_cast<int>(components);
  for (int c = 0; c < array.components; ++c) {
    const std::string said = element.attribute(fmt::format("ComponentName{}", c));
    array.component_names.push_back(said.empty() ? fmt::format("{}", c) : said);
  }
  return array;
}

void collect_offsets(const XmlElement& element, std::vector<std::uint64_t>& offsets) {
  if (element.name == "DataArray" && element.attribute("format") == "appended")
    offsets.push_back(static_cast<std::uint64_t>(integer(element, "offset", 0)));
  for (const XmlElement& child : element.children) collect_offsets(child, offsets);
}

}  // namespace

Extent parse_extent(const std::string& text) {
  std::string copy = text;
  const auto parts = numbers(copy);
  Extent extent{};
  for (std::size_t i = 0; i < 6 && parts.size() == 6; ++i) {
    const auto n = whole_number(parts[i]);
    constexpr std::int64_t most = 1 << 30;
    if (!n || *n < -most || *n > most) throw InputError(fmt::format("has the extent {}, too large", shown(text)));
    extent[i] = *n;
  }
  if (parts.size() != 6 || extent[0] >= extent[1] || extent[2] >= extent[3] || extent[4] >= extent[5])
    throw InputError(
        fmt::format("has the extent {}; expected the first and last point along x, y and z, such as "
                    "\"0 40 0 40 0 20\"",
                    shown(text)));
  return extent;
}

Vec3 parse_vector(const std::string& text, const Vec3& otherwise) {
  if (text.empty()) return otherwise;
  std::string copy = text;
  const auto parts = numbers(copy);
  Vec3 vector{};
  for (std::size_t a = 0; a < 3; ++a) {
    const auto x = parts.size() == 3 ? real_number(parts[a]) : std::nullopt;
    if (!x) throw InputError(fmt::format("has {} where three numbers are expected", shown(text)));
    vector[a] = *x;
  }
  return vector;
}

VtiFile::VtiFile(const std::filesystem::path& path) : file_(path) {
  // The appended section need not be XML: the text around it is parsed alone.
  const std::uint64_t appended = find(file_, appended_tag, 0);
  constexpr std::uint64_t longest = 1 << 30;
  if (appended > longest) throw InputError("has more than 1 GiB of XML; write it with appended data");
  std::string text = file_.text(0, appended);
  if (appended < file_.size()) {
    const std::uint64_t tag_end = find(file_, ">", appended) + 1;
    if (tag_end - appended > 256) throw InputError("is no VTK image: its appended section does not begin");
    text += file_.text(appended, tag_end) + "</AppendedData></VTKFile>";
    data_begin_ = find(file_, "_", tag_end) + 1;
    const std::uint64_t tail = file_.size() - std::min<std::uint64_t>(file_.size() - appended, 256);
    const std::string end = file_.text(tail, file_.size());
    const std::size_t closing = end.rfind("</AppendedData>");
    if (closing == std::string::npos || data_begin_ > tail + closing ||
        end.find("</VTKFile>", closing) == std::string::npos)
      throw InputError("is a VTK image that is cut short: its appended section does not end");
    data_end_ = tail + closing;
  }
  root_ = parse_xml(text);
  if (root_.name != "VTKFile" || root_.attribute("type") != "ImageData") throw InputError("is no VTK image (.vti)");
  if (const std::string compressor = root_.attribute("compressor");
      !compressor.empty() && compressor != "vtkZLibDataCompressor")
    throw InputError(fmt::format("is compressed by {}; write it with vtkZLibDataCompressor", shown(compressor)));

  const XmlElement* image = root_.child("ImageData");
  const XmlElement* piece = image != nullptr ? image->child("Piece") : nullptr;
  if (piece == nullptr) throw InputError("is a VTK image without a piece");
  extent_ = parse_extent(image->attribute("WholeExtent"));
  origin_ = parse_vector(image->attribute("Origin"), {0, 0, 0});
  spacing_ = parse_vector(image->attribute("Spacing"), {1, 1, 1});
  const auto pieces = std::count_if(image->children.begin(), image->children.end(),
                                    [](const XmlElement& element) { return element.name == "Piece"; });
  if (pieces != 1 || parse_extent(piece->attribute("Extent")) != extent_)
    throw InputError(
        fmt::format("is a VTK image whose piece has the extent {}, but the whole has {}; expected one "
                    "piece that covers it",
                    shown(piece->attribute("Extent")), shown(image->attribute("WholeExtent"))));
  for (const bool on_cells : {false, true})
    if (const XmlElement* data = piece->child(on_cells ? "CellData" : "PointData"); data != nullptr)
      for (const XmlElement& element : data->children)
        if (element.name == "DataArray") arrays_.push_back(array_of(element, on_cells));
  if (const XmlElement* section = root_.child("AppendedData"); section != nullptr) {
    encoded_ = section->attribute("encoding") != "raw";
    collect_offsets(root_, offsets_);
    std::sort(offsets_.begin(), offsets_.end());
  }
}

Int3 VtiFile::cells() const { return {extent_[1] - extent_[0], extent_[3] - extent_[2], extent_[5] - extent_[4]}; }

std::vector<std::byte> VtiFile::values(const VtiArray& array) const {
  if (!array.type)
    throw InputError(fmt::format("holds the array {} of the type {}, no numbers", shown(array.name),
                                 shown(array.element->attribute("type"))));
  VoxelHeader header{cells(), *array.type, false, {}};
  if (!array.on_cells)
    for (std::int64_t& n : header.size) ++n;
  const std::uint64_t count = bytes_of(header) * static_cast<std::uint64_t>(array.components);
  VtiEncoding encoding{!root_.attribute("compressor").empty(), root_.attribute("header_type") == "UInt64",
                       root_.attribute("byte_order") == "BigEndian"};

  const std::string format = array.element->attribute("format");
  if (format == "ascii") return read_ascii(array.element->text, *array.type, count / size_of(*array.type));
  std::vector<std::byte> values;
  if (format == "binary") {
    Base64Stream stream(array.element->text);
    values = read_block(stream, encoding, count);
    if (stream.position() != array.element->text.size())
      throw InputError("holds an array with more bytes than its header says");
  } else if (format == "appended" && data_begin_ > 0) {
    // Arrays lie one behind another: where this one ends, the next begins, or the section ends.
    const auto offset = static_cast<std::uint64_t>(integer(*array.element, "offset", 0));
    if (offset > data_end_ - data_begin_) throw InputError("holds an array that begins behind the end of the file");
    const auto next = std::upper_bound(offsets_.begin(), offsets_.end(), offset);
    const std::uint64_t begin = data_begin_ + offset;
    const std::uint64_t end = next == offsets_.end() ? data_end_ : std::min(data_end_, data_begin_ + *next);
    if (encoded_) {
      const std::string text = file_.text(begin, end);
      Base64Stream stream(text);
      values = read_block(stream, encoding, count);
      if (stream.position() != text.size()) throw InputError("holds an array with more bytes than its header says");
    } else {
      FileStream stream(file_, begin, end);
      values = read_block(stream, encoding, count);
      const std::string rest = file_.text(stream.position(), std::min(end, stream.position() + 64));
      if (end - stream.position() > 64 || rest.find_first_not_of(" \t\r\n") != std::string::npos)
        throw InputError("holds an array with more bytes than its header says");
    }
  } else {
    throw InputError(fmt::format("holds the array {} in the format {}; expected ascii, binary or appended",
                                 shown(array.name), shown(format)));
  }
  if (encoding.big_endian != (std::endian::native == std::endian::big)) swap_bytes(values, size_of(*array.type));
  return values;
}

}  // namespace koshi::io
