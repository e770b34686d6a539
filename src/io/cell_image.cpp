#include "io/cell_image.h"

#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkMetaImageReader.h>
#include <vtkNew.h>
#include <vtkNrrdReader.h>
#include <vtkPointData.h>
#include <vtkUnsignedShortArray.h>
#include <vtkXMLImageDataReader.h>

#include <cmath>
#include <fstream>
#include <map>
#include <optional>
#include <set>

#include "base/collective.h"
#include "io/image.h"
#include "io/npy.h"
#include "io/vtk_errors.h"
#include "model/check.h"
#include "model/regions.h"

namespace koshi::io {
namespace {

template <class Reader>
vtkSmartPointer<vtkImageData> read_with(const std::filesystem::path& file, const char* format) {
  vtkNew<Reader> reader;
  const VtkErrors errors;
  if (!reader->CanReadFile(file.c_str())) throw InputError(fmt::format("is not {}", format));
  reader->SetFileName(file.c_str());
  reader->Update();
  if (!errors.first().empty()) throw InputError(fmt::format("cannot be read as {}: {}", format, errors.first()));
  if (reader->GetErrorCode() != 0) throw InputError(fmt::format("cannot be read as {}; it may be cut short", format));
  return reader->GetOutput();
}

// VTK's reader takes the bytes of an encoding it does not know for the values.
void check_nrrd_encoding(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string key = "encoding:";
  for (std::string line; std::getline(stream, line) && !line.empty() && line != "\r";) {
    if (!line.starts_with(key)) continue;
    const auto first = line.find_first_not_of(' ', key.size()), last = line.find_last_not_of(" \r");
    const std::string encoding = first == std::string::npos ? "" : line.substr(first, last + 1 - first);
    if (encoding != "raw" && encoding != "gzip" && encoding != "gz")
      throw InputError(fmt::format("has the encoding \"{}\"; save it as \"raw\" or \"gzip\"", encoding));
  }
}

CellImage image_of(vtkDataArray* values, const Int3& cells, bool fractions) {
  if (values == nullptr || values->GetNumberOfTuples() != cells[0] * cells[1] * cells[2])
    throw InputError("holds no values");
  if (values->GetNumberOfComponents() != 1)
    throw InputError(fmt::format("holds {} values a cell; expected one", values->GetNumberOfComponents()));
  if (!fractions && (values->GetDataType() == VTK_FLOAT || values->GetDataType() == VTK_DOUBLE))
    throw InputError(fmt::format("holds values of the type {}, not whole numbers; convert it to unsigned char",
                                 values->GetDataTypeAsString()));
  return {cells, {1, cells[0], cells[0] * cells[1]}, [kept = vtkSmartPointer(values)](std::int64_t i) {
            return kept->GetComponent(i, 0);
          }};
}

CellImage image_of_points(vtkImageData* image, bool fractions) {
  const int* points = image->GetDimensions();
  vtkDataArray* values = image->GetPointData()->GetScalars();
  const int components = values == nullptr ? 1 : values->GetNumberOfComponents();
  // VTK takes a short first axis of an NRRD file for components; in memory they lie like an axis.
  if (components > 1 && points[2] == 1) {
    vtkSmartPointer<vtkDataArray> axis = vtk::TakeSmartPointer(values->NewInstance());
    axis->SetVoidArray(values->GetVoidPointer(0), values->GetNumberOfValues(), 1);
    CellImage folded = image_of(axis, {components, points[0], points[1]}, fractions);
    return {folded.cells, folded.stride,
            [kept = vtkSmartPointer(image), value = folded.value](std::int64_t i) { return value(i); }};
  }
  return image_of(image->GetPointData()->GetScalars(), {points[0], points[1], points[2]}, fractions);
}

// A file for ParaView may carry several arrays: the one of this name, as Koshi writes it, or the only one.
CellImage image_of_cells(vtkImageData* image, const char* name, bool fractions) {
  vtkCellData* data = image->GetCellData();
  if (data->GetNumberOfArrays() == 0 && image->GetPointData()->GetNumberOfArrays() != 0)
    throw InputError(
        "holds values on points, but a cell needs one value; make them cell data (ParaView: \"Point Data to Cell "
        "Data\", with categorical data on)");
  vtkDataArray* values = data->GetArray(name);
  if (values == nullptr && data->GetNumberOfArrays() == 1) values = data->GetArray(0);
  if (values == nullptr && data->GetNumberOfArrays() > 1)
    throw InputError(
        fmt::format("holds {} arrays on cells; call the right one \"{}\"", data->GetNumberOfArrays(), name));
  Int3 cells;
  for (int a = 0; a < 3; ++a) cells[a] = std::max(image->GetDimensions()[a] - 1, 1);
  return image_of(values, cells, fractions);
}

std::string list_of(const std::set<double>& values) {
  constexpr std::size_t most = 20;
  std::string text;
  for (const double value : values) text += fmt::format("{}{:.0f}", text.empty() ? "" : ", ", value);
  return text + (values.size() > most ? ", ..." : "");
}

CellImage read_image(const std::filesystem::path& file, const char* name, bool fractions) {
  const std::string format = file.extension().string();
  if (format == ".vti")
    return image_of_cells(read_with<vtkXMLImageDataReader>(file, "a VTK image (.vti)"), name, fractions);
  if (format == ".nrrd") check_nrrd_encoding(file);
  if (format == ".nrrd") return image_of_points(read_with<vtkNrrdReader>(file, "an NRRD image"), fractions);
  if (format == ".mha" || format == ".mhd")
    return image_of_points(read_with<vtkMetaImageReader>(file, "a MetaImage"), fractions);
  const NpyArray array = read_npy(file, fractions);
  CellImage image = image_of_points(array.image, fractions);
  if (array.fortran_order) {
    std::swap(image.cells[0], image.cells[2]);
    std::swap(image.stride[0], image.stride[2]);
  }
  return image;
}

// Calls f(value) for every cell, x fastest.
template <class F>
void for_each_value(const CellImage& image, F&& f) {
  for (std::int64_t k = 0; k < image.cells[2]; ++k)
    for (std::int64_t j = 0; j < image.cells[1]; ++j)
      for (std::int64_t i = 0; i < image.cells[0]; ++i)
        f(image.value(i * image.stride[0] + j * image.stride[1] + k * image.stride[2]));
}

}  // namespace

CellImage read_cell_image(const std::filesystem::path& file) { return read_image(file, "material", false); }
CellImage read_factor_image(const std::filesystem::path& file) { return read_image(file, "factor", true); }

void set_cells(const CellImage& image, model::Definition& definition) {
  const model::Checker check(definition);
  model::BodyDefinition& body = definition.body;

  // The image decides the size, or fits the size given.
  const double d = definition.lattice.spacing;
  const Vec3 size{d * static_cast<double>(image.cells[0]), d * static_cast<double>(image.cells[1]),
                  d * static_cast<double>(image.cells[2])};
  if (body.size == Vec3{}) body.size = size;
  if (norm(body.size - size) > 1e-6 * d)
    check.fail(
        "body.size",
        fmt::format("the image has {} x {} x {} cells and hence the size {:.9g} x {:.9g} x {:.9g} m, but the size "
                    "is {:.9g} x {:.9g} x {:.9g} m; leave size out",
                    image.cells[0], image.cells[1], image.cells[2], size[0], size[1], size[2], body.size[0],
                    body.size[1], body.size[2]));

  std::map<double, std::uint16_t> material_of;
  for (const auto& [value, name] : body.image_materials) {
    std::size_t index = 0;
    while (index < definition.materials.size() && definition.materials[index].name != name) ++index;
    material_of[value] = name == "void" ? 0 : static_cast<std::uint16_t>(index + 1);
  }

  // Neighbours mostly have the same value, so the last one found is tried first.
  std::set<double> unknown;
  auto last = material_of.end();
  body.cells.clear();
  body.cells.reserve(static_cast<std::size_t>(image.cells[0] * image.cells[1] * image.cells[2]));
  for_each_value(image, [&](double value) {
    if (last == material_of.end() || last->first != value) last = material_of.find(value);
    if (last == material_of.end() && unknown.size() < 21) unknown.insert(value);
    body.cells.push_back(last == material_of.end() ? 0 : last->second);
  });
  if (!unknown.empty())
    check.fail("body.materials",
               fmt::format("the image also has the value{} {}; name a material, or \"void\", for each",
                           unknown.size() == 1 ? "" : "s", list_of(unknown)));
}

void set_factors(const CellImage& image, model::Definition& definition) {
  const Int3 cells = model::make_grid(definition).cells;
  if (image.cells != cells)
    model::Checker(definition)
        .fail("body.factor", fmt::format("there are factors for {} x {} x {} cells, but the body has {} x {} x {}",
                                         image.cells[0], image.cells[1], image.cells[2], cells[0], cells[1], cells[2]));
  std::vector<float>& factors = definition.body.factors;
  factors.clear();
  factors.reserve(static_cast<std::size_t>(cells[0] * cells[1] * cells[2]));
  for_each_value(image, [&](double value) { factors.push_back(static_cast<float>(value)); });
}

namespace {

// Writes one value a cell, and returns the file's absolute name (collective).
template <class Array, class T>
std::string write_cell_values(const Communicator& communicator, const model::Definition& definition,
                              const std::filesystem::path& path, const char* name, std::vector<T>& values) {
  const std::filesystem::path file = std::filesystem::absolute(path);
  collectively(communicator, [&] {
    if (!communicator.is_root()) return;
    const double d = definition.lattice.spacing;
    vtkNew<vtkImageData> image;
    std::array<int, 3> points{};
    for (std::size_t a = 0; a < 3; ++a) points[a] = static_cast<int>(std::lround(definition.body.size[a] / d)) + 1;
    image->SetDimensions(points.data());
    image->SetSpacing(d, d, d);
    image->SetOrigin(definition.body.origin.data());
    vtkNew<Array> array;
    array->SetName(name);
    array->SetArray(values.data(), static_cast<vtkIdType>(values.size()), 1);
    image->GetCellData()->AddArray(array);
    write_image(file, image);
  });
  return file.string();
}

}  // namespace

model::Definition with_cells_in_file(const Communicator& communicator, model::Definition definition,
                                     const std::filesystem::path& directory) {
  model::BodyDefinition& body = definition.body;
  if (!body.factors.empty() && body.factor.empty())
    body.factor =
        write_cell_values<vtkFloatArray>(communicator, definition, directory / "factors.vti", "factor", body.factors);
  if (body.cells.empty() || !body.image.empty()) return definition;
  body.image = write_cell_values<vtkUnsignedShortArray>(communicator, definition, directory / "cells.vti", "material",
                                                        body.cells);
  body.image_materials = {{0, "void"}};
  for (std::size_t m = 0; m < definition.materials.size(); ++m)
    body.image_materials[static_cast<int>(m) + 1] = definition.materials[m].name;
  return definition;
}

}  // namespace koshi::io
