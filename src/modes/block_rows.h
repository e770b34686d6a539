// Products and combinations of a few dozen long vectors, each number read once. Compiled once per instruction set, as
// mechanics/row_kernels.h; plain pointers only.
#pragma once

#include <cstdint>

namespace koshi::modes {

/// Rows come in whole chunks' worth of memory: columns are padded with zeros to a multiple of `row_width`.
inline constexpr std::int64_t row_width = 8;

struct BlockKernels {
  /// out[i + a_count j] = a_i . b_j over `rows`, a multiple of row_width.
  void (*products)(const double* const* a, int a_count, const double* const* b, int b_count, std::int64_t rows,
                   double* out);
  /// out_j = sum_i in_i coefficient[i + in_count j]; an output may be one of the inputs.
  void (*combine)(const double* const* in, int in_count, const double* coefficient, double* const* out, int out_count,
                  std::int64_t rows);
};

/// Kernels for this processor.
const BlockKernels& block_kernels();

}  // namespace koshi::modes
