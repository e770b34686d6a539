// Forces of cells that a surface cuts, beside those of the cell kernel: the inner loop, compiled per instruction set
// like cell_strip.h.
#pragma once

#include <cstdint>

namespace koshi::mechanics {

/// Cells of a block.
inline constexpr int cut_lanes = 8;

/// Constants of a material in a cut cell [N/m], of amplitudes A as in cut_block.cpp.
struct CutConstants {
  double bulk, shear, cross;  ///< 4 d times the bulk modulus, C_1111 - C_1122 and C_1212 of the springs
  /// The stiffness of the whole cell as the cell kernel has it, with the rotations of its corners that make the energy
  /// smallest, by parity class: equal entries of the diagonal and beside it for P = 0, x and x + y + z; for P = x + y
  /// the one of shear and that of the third component.
  double none, none_cross, one, one_cross, two, third, three, three_cross;
};
inline constexpr int cut_constants = 11;

/// Values by lane.
using CutLanes = double[cut_lanes];

/// A block of cells.
struct alignas(64) CutBlock {
  CutLanes u[3][8];                   ///< displacements of the corners; then forces
  CutLanes moments[23];               ///< in the order of model/moments.h
  CutLanes constants[cut_constants];  ///< in the order of CutConstants
  CutLanes part;                      ///< factor on the energy of the part inside
  CutLanes whole;                     ///< factor on that of the whole cell, which goes
};

struct CutKernels {
  /// Displacements become forces: minus the gradient of part times the energy of the trilinear displacement over the
  /// part inside, with the mean dilatation there, less `whole` times the energy of the whole cell's springs.
  void (*forces)(CutBlock& block);
};

/// Kernels for this processor.
const CutKernels& cut_kernels();

}  // namespace koshi::mechanics
