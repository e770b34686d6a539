// Cells of a VTK XML image.
#include <fmt/format.h>

#include <algorithm>

#include "io/voxels/formats.h"
#include "io/vti_file.h"
#include "koshi/error.h"

namespace koshi::io {
namespace {

// A file for ParaView may carry several arrays: the one of this name, as Koshi writes it, or the only one.
const VtiArray& cell_array(const VtiFile& file, const std::string& name) {
  std::vector<const VtiArray*> on_cells;
  for (const VtiArray& array : file.arrays())
    if (array.on_cells) on_cells.push_back(&array);
  if (on_cells.empty() && !file.arrays().empty())
    throw InputError(
        "holds values on points, but a cell needs one value; make them cell data (ParaView: \"Point Data to Cell "
        "Data\", with categorical data on)");
  if (on_cells.empty()) throw InputError("holds no values");
  const auto named =
      std::find_if(on_cells.begin(), on_cells.end(), [&](const VtiArray* array) { return array->name == name; });
  if (named == on_cells.end() && on_cells.size() > 1)
    throw InputError(fmt::format("holds {} arrays on cells; call the right one \"{}\"", on_cells.size(), name));
  return named == on_cells.end() ? *on_cells.front() : **named;
}

}  // namespace

VoxelImage read_vti_image(const std::filesystem::path& path, const std::string& name) {
  const VtiFile file(path);
  const VtiArray& array = cell_array(file, name);
  if (array.components != 1) throw InputError(fmt::format("holds {} values a cell; expected one", array.components));
  const Int3 size = file.cells();
  std::vector<std::byte> values = file.values(array);
  return {size, {1, size[0], size[0] * size[1]}, *array.type, std::move(values), file.spacing()};
}

}  // namespace koshi::io
