// The other inner loops of a multigrid level, on rows of nodes in single precision: relaxation with node blocks,
// residual, transfer between levels. Compiled per instruction set like cell_strip.h.
#pragma once

#include <cstddef>
#include <cstdint>

namespace koshi::mechanics {

/// Nodes that share one entry of RelaxRow::block.
inline constexpr std::int64_t block_width = 16;

/// A row of nodes; pointers to node i = 0 of the first component, the next one lies a pitch away. `block[g]` serves the
/// block_width nodes from block_width g on: a negative entry ~m stands for the diagonal block uniform[3 m]
/// (displacements), uniform[3 m + 1] (rotations), in units of uniform[3 m + 2]; any other counts sets in `blocks`: the
/// lower triangle of the inverse node block, row by row, each entry for block_width nodes, in units of its own for each
/// node.
struct RelaxRow {
  const float* b;
  const float* x;
  float* y;
  std::ptrdiff_t pitch;
  const float* force;  ///< -K x
  std::ptrdiff_t force_pitch;
  const std::int32_t* block;
  const float* uniform;
  const std::int16_t* blocks;
  const float* units;  ///< block_width for each set
  std::int64_t count;  ///< nodes
};

/// All functions work on whole vectors and may rewrite up to a vector less one element beyond the row.
struct RelaxKernels {
  /// y = p x + q y + c B (b - K x) with the inverse node blocks B.
  void (*relax)(const RelaxRow&, int components, float p, float q, float c);
  /// y = c B b.
  void (*relax_zero)(const RelaxRow&, int components, float c);
  /// y = b - K x.
  void (*residual)(const RelaxRow&, int components);
  /// to = sum of weight[r] from[r] over `rows` rows, elements -1 ... count - 1.
  void (*combine)(float* to, const float* const* from, const float* weight, int rows, std::int64_t count);
  /// fine += scale P coarse along x, fine nodes 0 ... count - 1: (P c)[2 I] = c[I], (P c)[2 I + 1] = (c[I] + c[I +
  /// 1])/2.
  void (*prolong)(float* fine, const float* coarse, float scale, std::int64_t count);
  /// coarse = scale P^T fine along x, coarse nodes 0 ... count - 1.
  void (*restrict_)(float* coarse, const float* fine, float scale, std::int64_t count);
};

/// Kernels for this processor.
const RelaxKernels& relax_kernels();

}  // namespace koshi::mechanics
