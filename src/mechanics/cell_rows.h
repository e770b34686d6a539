// Forces of a row of cells on the rows of nodes around it: springs cell by cell instead of bond by bond, since the
// merged cells of a multigrid level differ from each other without limit. The same source (cell_rows.cpp) is compiled
// for several instruction sets; the widest one the processor has is chosen at run time.
//
// Plain structs and pointers only: code compiled for one instruction set must not leak into the rest of the program.
#pragma once

#include <cstddef>
#include <cstdint>

namespace koshi::mechanics {

/// Number of constants of a cell with shared springs. Unknowns are u and rho = (d/2) w, so that the spacing d drops
/// out: edges kn/16, kt/16; face diagonals (kn - kt)/16, kt/8; body diagonals (kn - kt)/12, kt/4; kappa d/16.
inline constexpr int cell_constants = 7;

/// A row of cells between four rows of nodes, r = 0 ... 3: (j, k), (j+1, k), (j, k+1), (j+1, k+1). Pointers to cell or
/// node i = 0 of the first constant or component; the next one lies a pitch away.
template <class T>
struct CellRow {
  const T* constants;
  std::ptrdiff_t constant_pitch;
  const T* u[4];
  std::ptrdiff_t u_pitch;
  T* force[4];
  std::ptrdiff_t force_pitch;
};

template <class T>
struct CellKernels {
  /// Adds the forces of cells first <= i < last to the four rows of nodes. Works on whole vectors of 64 bytes: reads
  /// and rewrites up to one vector beyond the last cell, where the constants must be zero and the unknowns finite.
  void (*rotational)(const CellRow<T>&, std::int64_t first, std::int64_t last);
  void (*least_squares)(const CellRow<T>&, std::int64_t first, std::int64_t last);
};

/// Kernels for this processor.
template <class T>
const CellKernels<T>& cell_kernels();

}  // namespace koshi::mechanics
