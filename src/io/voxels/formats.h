// Readers of image files, one a format. Each checks the header against the length of the file before it takes memory.
// Errors of all: InputError without a place, a predicate such as "is cut short".
#pragma once

#include <filesystem>
#include <functional>

#include "io/voxels/image.h"

namespace koshi::io {

/// NumPy (.npy), axes [z][y][x] in C or Fortran order.
VoxelImage read_npy(const std::filesystem::path& file);

/// MetaImage (.mha, or .mhd with its data file beside), raw or compressed.
VoxelImage read_metaimage(const std::filesystem::path& file);

/// NRRD (.nrrd, or .nhdr with its data file beside), encodings raw, gzip and bzip2.
VoxelImage read_nrrd(const std::filesystem::path& file);

/// NIfTI-1 (.nii, .nii.gz).
VoxelImage read_nifti(const std::filesystem::path& file);

/// TIFF (.tif, .tiff): each page is a layer of cells. "*" in the name stands for the number of a slice, and so does a
/// folder for all in it; then each file is one, and none may be missing.
VoxelImage read_tiff(const std::filesystem::path& file);

/// Values from this byte on to the end of the file.
VoxelImage read_raw(const std::filesystem::path& file, const VoxelHeader& header, std::uint64_t offset);

/// VTK XML image (.vti): the array of this name on cells, or the only one.
VoxelImage read_vti_image(const std::filesystem::path& file, const std::string& name);

/// Calls `read` with the data file that a header names; it lies beside the header. Errors get the data file's name.
VoxelImage read_beside(const std::filesystem::path& header, std::string_view name,
                       const std::function<VoxelImage(const InputFile&)>& read);

}  // namespace koshi::io
