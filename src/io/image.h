// A rank's part of a sample as a VTK image, and the VTK files made of it.
#pragma once

#include <vtkImageData.h>
#include <vtkSmartPointer.h>
#include <vtkXMLDataElement.h>

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <utility>

#include "io/field_writer.h"

namespace koshi::io {

/// Global point extent {x_lo, x_hi, y_lo, ...} of the piece of a rank with this layout: its owned nodes and the next
/// layer, so that neighbouring pieces share a face and no gap is left. Point `cells` of a periodic direction is the
/// first point again.
std::array<int, 6> piece_extent(const lattice::Grid& grid, const lattice::Layout& layout);

/// False for a rank that owns only the last layer of nodes: it has no cell, and its points are in its neighbour's
/// piece.
bool has_cells(const std::array<int, 6>& extent);

/// This rank's piece of a sample. Ghosts of the fields on nodes must be filled.
vtkSmartPointer<vtkImageData> make_image(const model::Model& model, std::span<const FieldData> fields, double time,
                                         bool mark_empty);

/// Writes an image as VTI, zlib-compressed: beside, then renamed. Throws RunError with the system's reason.
void write_image(const std::filesystem::path& path, vtkImageData* image);

/// PVTI header of a sample whose pieces have these extents and files (relative to the header's folder); the arrays are
/// those of `image`.
std::string parallel_header(const lattice::Grid& grid, vtkImageData* image,
                            std::span<const std::pair<std::array<int, 6>, std::string>> pieces);

/// An XML element of this name, and the text of a document with this root.
vtkSmartPointer<vtkXMLDataElement> element(const char* name);
std::string document(vtkXMLDataElement* root);

}  // namespace koshi::io
