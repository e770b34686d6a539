// Bodies given cell by cell: values in an image and the materials they stand for.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>

#include "koshi/communicator.h"
#include "koshi/definition.h"

namespace koshi::io {

/// One value per cell, where it lies: that of cell (i, j, k) is value(i stride[0] + j stride[1] + k stride[2]).
struct CellImage {
  Int3 cells{};
  Int3 stride{};
  std::function<double(std::int64_t)> value;
};

/// Reads .npy (axes [z][y][x]), .vti (values on cells), .mha, .mhd, .nrrd, .nhdr, .nii, .nii.gz, .tif or .tiff (values
/// of voxels): whole numbers or bool, as materials have. Voxels must be cubes; their size and the origin in the file do
/// not count. Errors: InputError without a place.
CellImage read_cell_image(const std::filesystem::path& file);

/// The same with whole numbers or fractions, as factors have.
CellImage read_factor_image(const std::filesystem::path& file);

/// Sets body.cells by body.image_materials, and body.size if it is unset. Errors: InputError at the image, its
/// materials or the size.
void set_cells(const CellImage& image, model::Definition& definition);

/// Sets body.factors; body.size must be known. Errors: InputError at body.factor.
void set_factors(const CellImage& image, model::Definition& definition);

/// The definition with cells and factors that a program gave in `directory`/cells.vti and factors.vti, so that its
/// resolved input names them (collective). Errors: RunError when the file cannot be written.
model::Definition with_cells_in_file(const Communicator& communicator, model::Definition definition,
                                     const std::filesystem::path& directory);

}  // namespace koshi::io
