// A first look at the strain of a row of cells: two numbers from which the criterion's bound follows. The same source
// (strain_rows.cpp) is compiled for several instruction sets; the widest one the processor has is chosen at run time.
#pragma once

#include <cstddef>
#include <cstdint>

namespace koshi::failure {

/// Displacements around a row of cells: x component of node i = 0 of the node rows (j, k), (j+1, k), (j, k+1),
/// (j+1, k+1); the other components lie `component` further each.
struct StrainRow {
  const double* u[4];
  std::ptrdiff_t component;
};

/// Mean strain tr/3 and radius of the deviator (theory, 12: p and r) of cells 0 <= i < cells; `scale` is 1/(4 d).
using StrainRows = void (*)(const StrainRow& row, double scale, std::int64_t cells, double* mean, double* radius);

/// The function for this processor.
StrainRows strain_rows();

}  // namespace koshi::failure
