#include "io/cell_image.h"

#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkUnsignedShortArray.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>

#include "base/collective.h"
#include "io/image.h"
#include "io/scan_cells.h"
#include "io/voxels/formats.h"
#include "model/check.h"
#include "model/regions.h"

namespace koshi::io {
namespace {

// A cell is a cube: an image whose voxels are none would be squeezed.
void check_cubes(const VoxelImage& image) {
  if (!image.voxel) return;
  const Vec3& side = *image.voxel;
  const auto [least, greatest] = std::minmax({side[0], side[1], side[2]});
  if (!(least > 0) || !std::isfinite(greatest) || greatest <= 1.001 * least) return;
  throw InputError(fmt::format(
      "has voxels of {:.6g} x {:.6g} x {:.6g}, but cells are cubes; resample it to voxels of one side first, such as "
      "with scipy.ndimage.zoom by {:.6g}, {:.6g}, {:.6g} along x, y, z (order = 0)",
      side[0], side[1], side[2], side[0] / least, side[1] / least, side[2] / least));
}

// What the input says of a raw file.
VoxelHeader raw_header(const model::ScanDefinition& scan) {
  // In the order of ScanDefinition::Type.
  using enum ValueType;
  constexpr std::array types{int8, uint8, int16, uint16, int32, uint32, float32, float64};
  VoxelHeader header;
  for (std::size_t a = 0; a < 3; ++a) header.size[a] = static_cast<std::int64_t>((*scan.size)[a]);
  header.type = types[static_cast<std::size_t>(scan.type)];
  header.big_endian = scan.byte_order == model::ScanDefinition::ByteOrder::big;
  return header;
}

CellImage read_image(const std::filesystem::path& file, const char* name, bool fractions,
                     const std::optional<model::ScanDefinition>& scan) {
  const std::string format = file.extension().string();
  // Without a format it is a folder of slices.
  const bool tiff = format == ".tif" || format == ".tiff" || format.empty(),
             nifti = format == ".nii" || format == ".gz";
  const auto image = std::make_shared<VoxelImage>(
      format == ".vti"                         ? read_vti_image(file, name)
      : format == ".nrrd" || format == ".nhdr" ? read_nrrd(file)
      : format == ".npy"                       ? read_npy(file)
      : tiff                                   ? read_tiff(file)
      : nifti                                  ? read_nifti(file)
      : format == ".raw" && scan ? read_raw(file, raw_header(*scan), static_cast<std::uint64_t>(scan->offset))
                                 : read_metaimage(file));
  check_cubes(*image);
  if (!fractions && !is_whole(image->type))
    throw InputError(
        fmt::format("holds values of the type {}, not whole numbers; convert it to uint8, say, or sort its values by "
                    "scan.thresholds",
                    name_of(image->type)));
  return {image->size, image->stride,
          [image](std::int64_t i) { return value_at(image->bytes, image->type, static_cast<std::size_t>(i)); },
          image->voxel};
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

CellImage read_cell_image(const std::filesystem::path& file, const std::optional<model::ScanDefinition>& scan) {
  return read_image(file, "material", scan && !(scan->thresholds.empty() && scan->grey.empty()), scan);
}
CellImage read_factor_image(const std::filesystem::path& file) { return read_image(file, "factor", true, {}); }

void set_cells(const CellImage& image, model::Definition& definition) {
  const model::Checker check(definition);
  model::BodyDefinition& body = definition.body;
  // Mixtures of an image read before are made anew.
  definition.materials.resize(definition.materials.size() - body.mixtures.size());
  ScanCells scan = cells_of(kept_part(image, definition), definition);

  // The image decides the spacing where it is asked to.
  double& d = definition.lattice.spacing;
  if (d == 0) {
    if (!image.voxel)
      check.fail("lattice.spacing",
                 "the image does not say how large its voxels are; give the spacing, such as spacing = \"10 um\"");
    d = (*image.voxel)[0] * *body.scan->unit * body.scan->coarsen;
    check.within(model::ranges::spacing, "lattice.spacing", d);
    body.scan->unit.reset();
  }

  // It decides the size, too, or fits the size given.
  const Int3& cells = scan.cells;
  const Vec3 size{d * static_cast<double>(cells[0]), d * static_cast<double>(cells[1]),
                  d * static_cast<double>(cells[2])};
  if (body.size == Vec3{}) body.size = size;
  if (norm(body.size - size) > 1e-6 * d)
    check.fail(
        "body.size",
        fmt::format("the image has {} x {} x {} cells and hence the size {:.9g} x {:.9g} x {:.9g} m, but the size "
                    "is {:.9g} x {:.9g} x {:.9g} m; leave size out",
                    cells[0], cells[1], cells[2], size[0], size[1], size[2], body.size[0], body.size[1], body.size[2]));
  body.cells = std::move(scan.material);
  body.mixtures = std::move(scan.mixtures);
  definition.materials.insert(definition.materials.end(), scan.mixture_materials.begin(), scan.mixture_materials.end());
  body.factors = std::move(scan.factor);
  body.density_shares = std::move(scan.density_share);
}

namespace {

// Fills `values`, which `what` names, from an image that must have the body's cells.
template <class T>
void set_values(const CellImage& image, const model::Definition& definition, const std::string& key, const char* what,
                std::vector<T>& values) {
  const Int3 cells = model::make_grid(definition).cells;
  if (image.cells != cells)
    model::Checker(definition)
        .fail(key, fmt::format("there are {} for {} x {} x {} cells, but the body has {} x {} x {}", what,
                               image.cells[0], image.cells[1], image.cells[2], cells[0], cells[1], cells[2]));
  values.clear();
  values.reserve(static_cast<std::size_t>(cells[0] * cells[1] * cells[2]));
  for_each_value(image, [&](double value) { values.push_back(static_cast<T>(value)); });
}

}  // namespace

void set_factors(const CellImage& image, model::Definition& definition) {
  std::vector<float> values;
  set_values(image, definition, "body.factor", "factors", values);
  std::vector<float>& factors = definition.body.factors;
  if (factors.empty()) factors.assign(values.size(), 1);
  std::ranges::transform(factors, values, factors.begin(), std::multiplies<float>());
}

void set_strengths(const CellImage& image, model::Definition& definition) {
  set_values(image, definition, "body.strength", "strengths", definition.body.strengths);
}

void set_grain_labels(const CellImage& image, model::Definition& definition) {
  constexpr double most = std::numeric_limits<std::int32_t>::max();
  for_each_value(image, [&](double value) {
    if (std::abs(value) > most)
      model::Checker(definition)
          .fail("body.grain_boundary.labels",
                fmt::format("the label {:.0f} is too large; number the grains from 1", value));
  });
  set_values(image, definition, "body.grain_boundary.labels", "labels", definition.body.grain_boundary->label_of_cells);
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
  // An image gives its factors again when it is read.
  if (!body.factors.empty() && body.factor.empty() && body.image.empty())
    body.factor =
        write_cell_values<vtkFloatArray>(communicator, definition, directory / "factors.vti", "factor", body.factors);
  if (!body.strengths.empty() && body.strength.empty())
    body.strength = write_cell_values<vtkFloatArray>(communicator, definition, directory / "strengths.vti", "factor",
                                                     body.strengths);
  if (auto& grains = body.grain_boundary; grains && !grains->label_of_cells.empty() && grains->labels.empty())
    grains->labels = write_cell_values<vtkIntArray>(communicator, definition, directory / "grains.vti", "material",
                                                    grains->label_of_cells);
  if (body.cells.empty() || !body.image.empty()) return definition;
  body.image = write_cell_values<vtkUnsignedShortArray>(communicator, definition, directory / "cells.vti", "material",
                                                        body.cells);
  body.image_materials = {{0, "void"}};
  for (std::size_t m = 0; m < definition.materials.size(); ++m)
    body.image_materials[static_cast<int>(m) + 1] = definition.materials[m].name;
  return definition;
}

}  // namespace koshi::io
