#include "io/npy.h"

#include <fmt/format.h>
#include <vtkImageReader2.h>
#include <vtkNew.h>

#include <array>
#include <fstream>
#include <map>
#include <regex>

#include "io/vtk_errors.h"
#include "koshi/error.h"

namespace koshi::io {
namespace {

// The format: https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html. Only the header is read here, the
// values by VTK. No package offers more: xtensor's reader does not notice a file that is cut short.
struct Header {
  std::string text;       ///< a Python dictionary
  std::size_t bytes = 0;  ///< from the start of the file to the values
};

Header read_header(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::array<unsigned char, 12> start{};
  stream.read(reinterpret_cast<char*>(start.data()), 10);
  if (!stream || std::string(start.begin(), start.begin() + 6) != "\x93NUMPY") throw InputError("is no NumPy file");
  Header header;
  std::size_t length = start[8] + 256u * start[9];
  header.bytes = 10 + length;
  // From version 2 on the length has four bytes.
  if (start[6] >= 2) {
    stream.read(reinterpret_cast<char*>(start.data()) + 10, 2);
    length += 65536u * start[10] + 16777216u * start[11];
    header.bytes = 12 + length;
  }
  if (length > 65536 || header.bytes > std::filesystem::file_size(file))
    throw InputError("is a NumPy file with a broken header");
  header.text.resize(length);
  stream.read(header.text.data(), static_cast<std::streamsize>(length));
  return header;
}

std::string field(const Header& header, const std::string& key, const std::string& pattern) {
  std::smatch match;
  if (!std::regex_search(header.text, match, std::regex("'" + key + "': *(" + pattern + ")")))
    throw InputError(fmt::format("is a NumPy file without a readable \"{}\"", key));
  return match[1];
}

}  // namespace

NpyArray read_npy(const std::filesystem::path& file, bool fractions) {
  const Header header = read_header(file);

  const std::string type = field(header, "descr", "'[^']*'|\\[[^\\]]*\\]");
  static const std::map<std::string, std::pair<int, int>> types{
      {"b1", {VTK_UNSIGNED_CHAR, 1}}, {"i1", {VTK_SIGNED_CHAR, 1}},    {"u1", {VTK_UNSIGNED_CHAR, 1}},
      {"i2", {VTK_SHORT, 2}},         {"u2", {VTK_UNSIGNED_SHORT, 2}}, {"i4", {VTK_INT, 4}},
      {"u4", {VTK_UNSIGNED_INT, 4}},  {"i8", {VTK_LONG_LONG, 8}},      {"u8", {VTK_UNSIGNED_LONG_LONG, 8}},
      {"f4", {VTK_FLOAT, 4}},         {"f8", {VTK_DOUBLE, 8}}};
  const auto known = type.size() == 5 ? types.find(type.substr(2, 2)) : types.end();
  const bool is_fraction = known != types.end() && known->first[0] == 'f';
  if (fractions && known == types.end())
    throw InputError(fmt::format("holds values of the type {}; convert it with astype(\"float32\")", type));
  if (known == types.end() || (is_fraction && !fractions))
    throw InputError(
        fmt::format("holds values of the type {}, not whole numbers; convert it with astype(\"uint8\")", type));
  const auto [scalar_type, bytes] = known->second;

  const std::string shape = field(header, "shape", "\\([^)]*\\)");
  std::smatch axes;
  if (!std::regex_match(shape, axes, std::regex(R"(\((\d{1,9}), *(\d{1,9}), *(\d{1,9})\))")))
    throw InputError(fmt::format("has the shape {}; expected three axes, [z][y][x]", shape));
  NpyArray array;
  array.fortran_order = field(header, "fortran_order", "True|False") == "True";
  std::array<int, 3> size{std::stoi(axes[3]), std::stoi(axes[2]), std::stoi(axes[1])};
  const double values = 1.0 * size[0] * size[1] * size[2];
  if (values == 0) throw InputError(fmt::format("has the shape {} and hence no cells", shape));
  if (static_cast<double>(header.bytes) + values * bytes != static_cast<double>(std::filesystem::file_size(file)))
    throw InputError(fmt::format("is not as long as its shape {} asks for; it may be cut short", shape));
  if (array.fortran_order) std::swap(size[0], size[2]);

  vtkNew<vtkImageReader2> reader;
  const VtkErrors errors;
  reader->SetFileName(file.c_str());
  reader->SetHeaderSize(header.bytes);
  reader->SetFileDimensionality(3);
  reader->SetFileLowerLeft(1);
  reader->SetDataExtent(0, size[0] - 1, 0, size[1] - 1, 0, size[2] - 1);
  reader->SetDataScalarType(scalar_type);
  if (type[1] == '>')
    reader->SetDataByteOrderToBigEndian();
  else
    reader->SetDataByteOrderToLittleEndian();
  reader->Update();
  if (!errors.first().empty()) throw InputError("cannot be read: " + errors.first());
  array.image = reader->GetOutput();
  return array;
}

}  // namespace koshi::io
