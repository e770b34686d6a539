// Bodies given cell by cell: values in an image and the materials they stand for.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>

#include "koshi/communicator.h"
#include "koshi/definition.h"

namespace koshi::io {

/// One value per cell, where it lies: that of cell (i, j, k) is value(i stride[0] + j stride[1] + k stride[2]).
struct CellImage {
  Int3 cells{};
  Int3 stride{};
  std::function<double(std::int64_t)> value;
  std::optional<Vec3> voxel{};  ///< sides of a voxel in the file's unit of length, where the file has them
};

/// Reads .npy (axes [z][y][x]), .vti (values on cells), .mha, .mhd, .nrrd, .nhdr, .nii, .nii.gz, .tif, .tiff or .raw
/// (values of voxels, a raw file as the scan says): whole numbers or bool, as materials have, and fractions where the
/// scan sorts them. Voxels must be cubes; the origin in the file does not count. Errors: InputError without a place.
CellImage read_cell_image(const std::filesystem::path& file, const std::optional<model::ScanDefinition>& scan = {});

/// The same with whole numbers or fractions, as factors have.
CellImage read_factor_image(const std::filesystem::path& file);

/// Sets body.cells by body.scan and body.image_materials, mixtures and their materials, factors and shares of density
/// where cells are partly filled, the spacing where it is that of the image, and body.size if it is unset. Errors:
/// InputError at the image, its materials, scan or size.
void set_cells(const CellImage& image, model::Definition& definition);

/// Sets body.factors, or multiplies those that the image set; body.size must be known. Errors: InputError at
/// body.factor.
void set_factors(const CellImage& image, model::Definition& definition);
/// Sets body.strengths, and the labels of body.grain_boundary, likewise.
void set_strengths(const CellImage& image, model::Definition& definition);
void set_grain_labels(const CellImage& image, model::Definition& definition);

/// The definition with the values of cells that a program gave in files of `directory`, cells.vti and others, so
/// that its resolved input names them (collective). Errors: RunError when the file cannot be written.
model::Definition with_cells_in_file(const Communicator& communicator, model::Definition definition,
                                     const std::filesystem::path& directory);

}  // namespace koshi::io
