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
  /// The stiffness of the whole cell as the cell kernel has it, by parity class: equal entries of the diagonal and
  /// beside it for P = 0, x and x + y + z; for P = x + y those of the two components in the plane, the entries between
  /// them and the third one, and that one's own.
  double none, none_cross, one, one_cross, two, two_cross, two_third, third, three, three_cross;
  /// What displacements give to node rotations that turn with the cell, by parity class; zero without node rotations.
  double turn_none, turn_one, turn_one_axis, turn_two, turn_two_third, turn_three;
  double per_d;  ///< 1/d
  double tie;    ///< of loose corners to the turn of their cell [N m]
};
inline constexpr int cut_constants = 21;

/// Values by lane.
using CutLanes = double[cut_lanes];

/// A block of cells.
struct alignas(64) CutBlock {
  CutLanes u[3][8];                   ///< displacements of the corners; then forces
  CutLanes w[3][8];                   ///< rotations of the corners; then moments
  CutLanes loose[8];                  ///< of the corners: 1 where their rotations feel no strain, else 0
  CutLanes moments[23];               ///< in the order of model/moments.h
  CutLanes constants[cut_constants];  ///< in the order of CutConstants
  CutLanes part;                      ///< factor on the energy of the part inside
  CutLanes whole;                     ///< factor on that of the whole cell with rotations that turn with it, which goes
  CutLanes coupled;                   ///< factor on what ties strain and rotations, which goes where they are loose
};

struct CutKernels {
  /// Displacements become forces: minus the gradient of part times the energy of the trilinear displacement over the
  /// part inside, with the mean dilatation there, less `whole` times the energy of the whole cell's springs.
  void (*forces)(CutBlock& block, bool rotational);
};

/// Kernels for this processor.
const CutKernels& cut_kernels();

}  // namespace koshi::mechanics
