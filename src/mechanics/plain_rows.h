// The inner loop of the plain kernel, compiled for several instruction sets like mechanics/cell_strip.h.
#pragma once

#include <cstddef>
#include <cstdint>

namespace koshi::mechanics {

/// One bond of every node in a row, to the node `to` elements on.
struct BondRow {
  const double* u;        ///< component 0 of the row's first node
  std::ptrdiff_t pitch;   ///< from a component of u to the next
  std::ptrdiff_t to;      ///< to the other end
  const double *kn, *kt;  ///< stiffness of the bonds [N/m]; zero where there is none
  double D[3];            ///< x_near - x_far [m]
  double* const* force;   ///< by component, added to
  std::int64_t nodes;
};

struct PlainKernels {
  /// Adds the forces of the bonds on the near nodes; without rotations those of the displacements alone. Works on whole
  /// lines of 64 bytes.
  void (*add_bonds)(const BondRow& row, int components);
};

/// Kernels for this processor.
const PlainKernels& plain_kernels();

}  // namespace koshi::mechanics
