// Arrays of numbers in NumPy's file format.
#pragma once

#include <vtkImageData.h>
#include <vtkSmartPointer.h>

#include <filesystem>

namespace koshi::io {

/// Array of a .npy file, its values as the image's scalars in the file's order.
struct NpyArray {
  vtkSmartPointer<vtkImageData> image;
  bool fortran_order = false;  ///< the image's x axis is the array's first axis, not its last
};

/// Errors: InputError without a place for anything but three axes of whole numbers, bool or, if `fractions`, floating
/// point.
NpyArray read_npy(const std::filesystem::path& file, bool fractions);

}  // namespace koshi::io
