// First looks at rows of cells and nodes: how strained, how fast. The same source (strain_rows.cpp) is compiled for
// several instruction sets; the widest one the processor has is chosen at run time.
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

struct StrainRows {
  /// Mean strain tr/3 and radius of the deviator (theory, 12: p and r) of cells 0 <= i < cells; `scale` is 1/(4 d).
  void (*strain)(const StrainRow& row, double scale, std::int64_t cells, double* mean, double* radius);
  /// The least and the largest of count >= 1 numbers.
  void (*range)(const double* x, std::int64_t count, double* low, double* high);
};

/// Functions for this processor.
const StrainRows& strain_rows();

}  // namespace koshi::failure
