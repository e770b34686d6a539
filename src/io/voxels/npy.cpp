// NumPy's file format: a magic number, the length of a header, a Python dictionary of three entries, the values.
// https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html
#include <fmt/format.h>

#include <array>
#include <map>

#include "base/escape.h"
#include "io/voxels/formats.h"
#include "io/voxels/header_text.h"
#include "koshi/error.h"

namespace koshi::io {
namespace {

struct Dictionary {
  std::string text;
  std::uint64_t end = 0;  ///< where the values begin
};

Dictionary read_dictionary(const InputFile& file) {
  const std::string start = file.text(0, 12);
  if (!start.starts_with("\x93NUMPY") || start.size() < 10) throw InputError("is no NumPy file");
  const auto byte = [&](std::size_t at) -> std::uint64_t {
    return at < start.size() ? static_cast<unsigned char>(start[at]) : 0;
  };
  // From version 2 on the length has four bytes.
  const bool wide = byte(6) >= 2;
  const std::uint64_t begin = wide ? 12 : 10;
  const std::uint64_t length = byte(8) + (byte(9) << 8) + (wide ? (byte(10) << 16) + (byte(11) << 24) : 0);
  constexpr std::uint64_t longest = 10000;  // NumPy's own limit
  if (length > longest)
    throw InputError(
        fmt::format("is a NumPy file with a header of {} characters; at most {} are read", length, longest));
  if (begin + length > file.size()) throw InputError("is a NumPy file that is cut short in its header");
  return {file.text(begin, begin + length), begin + length};
}

// Reads `{'descr': '<i2', 'fortran_order': False, 'shape': (2, 3, 4), }`: entries in any order.
class Parser {
 public:
  explicit Parser(std::string_view text) : text_(text) {}

  void read() {
    expect('{');
    while (!take('}')) {
      const std::string key = quoted();
      expect(':');
      if (key == "descr")
        descr = value();
      else if (key == "fortran_order")
        order = value();
      else if (key == "shape")
        shape = value();
      else
        throw InputError(fmt::format("is a NumPy file with the unknown entry {}", shown(key)));
      if (take(',')) continue;
      expect('}');
      break;
    }
    skip();
    if (at_ != text_.size() || descr.empty() || order.empty() || shape.empty()) fail();
  }

  std::string descr, order, shape;

 private:
  [[noreturn]] static void fail() { throw InputError("is a NumPy file with a broken header"); }
  void skip() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\n')) ++at_;
  }
  bool take(char c) {
    skip();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  void expect(char c) {
    if (!take(c)) fail();
  }
  std::string up_to(char last) {
    const std::size_t end = text_.find(last, at_ + 1);
    if (end == std::string_view::npos) fail();
    const std::string part(text_.substr(at_, end + 1 - at_));
    at_ = end + 1;
    return part;
  }
  std::string quoted() {
    skip();
    if (at_ >= text_.size() || text_[at_] != '\'') fail();
    const std::string part = up_to('\'');
    return part.substr(1, part.size() - 2);
  }
  // A text in quotes, a tuple, a list, or a word.
  std::string value() {
    skip();
    if (at_ >= text_.size()) fail();
    const char first = text_[at_];
    if (first == '\'' || first == '(' || first == '[') return up_to(first == '\'' ? '\'' : first == '(' ? ')' : ']');
    const std::size_t end = text_.find_first_of(",} \n", at_);
    if (end == std::string_view::npos || end == at_) fail();
    const std::string part(text_.substr(at_, end - at_));
    at_ = end;
    return part;
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

void read_type(const std::string& descr, VoxelHeader& header) {
  using enum ValueType;
  static const std::map<std::string, ValueType> types{{"b1", uint8},  {"i1", int8},    {"u1", uint8},  {"i2", int16},
                                                      {"u2", uint16}, {"i4", int32},   {"u4", uint32}, {"i8", int64},
                                                      {"u8", uint64}, {"f4", float32}, {"f8", float64}};
  const auto known = descr.size() == 5 && std::string("<>|=").find(descr[1]) != std::string::npos
                         ? types.find(descr.substr(2, 2))
                         : types.end();
  if (known == types.end())
    throw InputError(
        fmt::format("holds values of the type {}, no numbers of 1 to 8 bytes; convert it with "
                    "astype(\"uint8\")",
                    shown(descr)));
  header.type = known->second;
  header.big_endian = descr[1] == '>';
}

Int3 read_shape(const std::string& shape) {
  Int3 axes{};
  std::size_t count = 0;
  std::string text = shape.substr(1, shape.size() - 2);
  for (char& c : text)
    if (c == ',') c = ' ';
  for (const std::string_view part : words(text)) {
    const auto n = whole_number(part);
    if (!n || *n < 0 || shape[0] != '(') throw InputError("is a NumPy file with a broken header");
    if (count < 3) axes[count] = *n;
    ++count;
  }
  if (count != 3)
    throw InputError(fmt::format("has the shape {}; expected three axes, [z][y][x]", shape.substr(0, 60)));
  return axes;
}

}  // namespace

VoxelImage read_npy(const std::filesystem::path& path) {
  const InputFile file(path);
  const Dictionary dictionary = read_dictionary(file);
  Parser parser(dictionary.text);
  parser.read();
  if (parser.order != "True" && parser.order != "False") throw InputError("is a NumPy file with a broken header");
  const bool fortran = parser.order == "True";

  // In C order the last axis, x, runs fastest; in Fortran order the first, z.
  VoxelHeader header;
  read_type(parser.descr, header);
  const Int3 shape = read_shape(parser.shape);
  header.size = fortran ? shape : Int3{shape[2], shape[1], shape[0]};
  if (shape[0] == 0 || shape[1] == 0 || shape[2] == 0)
    throw InputError(fmt::format("has the shape {} and hence no cells", parser.shape));

  ByteSource source(file, dictionary.end, file.size(), Compression::none);
  VoxelImage image = read_values(header, source);
  if (fortran) {
    std::swap(image.size[0], image.size[2]);
    std::swap(image.stride[0], image.stride[2]);
  }
  return image;
}

}  // namespace koshi::io
