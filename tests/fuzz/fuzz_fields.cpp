// Samples of a run against arbitrary files. The first byte says which one of a directory of results is replaced: the
// collection, the header of the pieces, or a piece.
#include <cstdlib>
#include <fstream>

#include "io/field_reader.h"
#include "koshi/error.h"
#include "support/temporary_directory.h"

namespace {

namespace fs = std::filesystem;

void write(const fs::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
}

// Two pieces of one cell each, side by side.
std::string piece(int x) {
  const std::string extent = std::to_string(x) + " " + std::to_string(x + 1) + " 0 1 0 1";
  return "<VTKFile type=\"ImageData\"><ImageData WholeExtent=\"" + extent + "\"><Piece Extent=\"" + extent +
         "\"><PointData><DataArray type=\"Float64\" Name=\"u\" format=\"ascii\">1 2 3 4 5 6 7 8</DataArray></PointData>"
         "<CellData><DataArray type=\"UInt16\" Name=\"material\" format=\"ascii\">1</DataArray></CellData></Piece>"
         "</ImageData></VTKFile>";
}
const std::string whole =
    "<VTKFile type=\"PImageData\"><PImageData WholeExtent=\"0 2 0 1 0 1\"><Piece Extent=\"0 1 0 1 0 1\" "
    "Source=\"a.vti\"/><Piece Extent=\"1 2 0 1 0 1\" Source=\"b.vti\"/></PImageData></VTKFile>";
const std::string collection =
    "<VTKFile type=\"Collection\"><Collection><DataSet timestep=\"0\" file=\"s.pvti\"/></Collection></VTKFile>";

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  static const koshi::test::TemporaryDirectory directory;
  const fs::path names[] = {directory / "fields.pvd", directory / "s.pvti", directory / "a.vti", directory / "b.vti"};
  const std::string contents[] = {collection, whole, piece(0), piece(1)};
  for (std::size_t f = 0; f < 4; ++f)
    write(names[f], f == data[0] % 4U ? std::string(reinterpret_cast<const char*>(data) + 1, size - 1) : contents[f]);
  try {
    for (const auto& sample : koshi::io::list_samples(directory.path())) {
      const koshi::io::FieldReader reader(sample.path);
      const koshi::Int3 cells = reader.cells();
      const std::int64_t count = cells[0] * cells[1] * cells[2];
      if (reader.material().size() != static_cast<std::size_t>(count)) std::abort();
      const std::int64_t ends[] = {0, count - 1};
      for (const auto& field : reader.fields())
        if (reader.gather(field, ends).size() != 2 * field.components.size()) std::abort();
    }
  } catch (const koshi::InputError&) {
  }
  return 0;
}
