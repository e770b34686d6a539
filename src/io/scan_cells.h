// From the voxels of an image to cells: cut, turned, sorted by grey value, merged.
#pragma once

#include "io/cell_image.h"

namespace koshi::io {

/// What of the image the scan keeps, its axes in the body's order. Errors: InputError at body.scan.
CellImage kept_part(const CellImage& image, const model::Definition& definition);

/// Cells of a body and what fills them.
struct ScanCells {
  Int3 cells{};
  std::vector<std::uint16_t> material;                       ///< x fastest
  std::vector<float> factor;                                 ///< on the stiffness; empty: all 1
  std::vector<float> density_share;                          ///< on the density; empty: all 1
  std::vector<model::Mixture> mixtures;                      ///< of two solids in a cell
  std::vector<model::MaterialDefinition> mixture_materials;  ///< theirs, to follow those of the definition
};

/// Materials by image_materials or, where the scan has densities, the body's material. A coarse cell of several voxels
/// is of the material of its solid voxels, or of a mixture of the two with most (CellMixtures), and stiffness and
/// density have the share that is solid as a factor; its density is that of the mean grey value. Errors: InputError at
/// body.scan, or at body.materials for values that have none.
ScanCells cells_of(const CellImage& kept, const model::Definition& definition);

}  // namespace koshi::io
