#include "io/polygon_file.h"

#include <fmt/format.h>

#include <iterator>

#include "io/files.h"

namespace koshi::io {
namespace {

// An array of a VTK XML file, as text; numbers are the shortest that read back as the same.
template <class T>
void add_array(std::string& out, const char* type, const std::string& name, int components,
               const std::vector<T>& values) {
  out += fmt::format("<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"ascii\">\n", type, name,
                     components);
  for (const T& value : values) fmt::format_to(std::back_inserter(out), "{}\n", value);
  out += "</DataArray>\n";
}

}  // namespace

void write_polygons(const std::filesystem::path& path, std::span<const std::vector<Vec3>> polygons,
                    const PolygonValues& values) {
  std::vector<double> points;
  std::vector<std::int64_t> corners, ends;
  for (const std::vector<Vec3>& polygon : polygons) {
    for (const Vec3& corner : polygon) {
      corners.push_back(static_cast<std::int64_t>(corners.size()));
      points.insert(points.end(), corner.begin(), corner.end());
    }
    ends.push_back(static_cast<std::int64_t>(corners.size()));
  }

  std::string out = fmt::format(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<PolyData>\n<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"0\" "
      "NumberOfStrips=\"0\" NumberOfPolys=\"{}\">\n<CellData>\n",
      corners.size(), polygons.size());
  for (const auto& [name, numbers] : values) {
    const std::size_t components = polygons.empty() ? 1 : numbers.size() / polygons.size();
    add_array(out, "Float64", name, static_cast<int>(components), numbers);
  }
  out += "</CellData>\n<Points>\n";
  add_array(out, "Float64", "Points", 3, points);
  out += "</Points>\n<Polys>\n";
  add_array(out, "Int64", "connectivity", 1, corners);
  add_array(out, "Int64", "offsets", 1, ends);
  out += "</Polys>\n</Piece>\n</PolyData>\n</VTKFile>\n";
  replace_file(path, out);
}

}  // namespace koshi::io
