// Forces of a strip of cells along x: the inner loops of the cell kernel. The same source (cell_strip.cpp) is compiled
// for several instruction sets; the widest one the processor has is chosen at run time.
//
// A strip of cells lies between four rows of nodes. Sums and differences over x and z of the two node rows at its lower
// side in y are known from the strip before; a sweep through rising y so needs those of two new node rows alone, and
// gives forces back in the same way.
//
// Plain structs and pointers only: code compiled for one instruction set must not leak into the rest of the program.
#pragma once

#include <cstddef>
#include <cstdint>

namespace koshi::mechanics {

/// Constants of a cell with shared springs. Unknowns are u and rho = (d/2) w, so that the spacing d drops
/// out: edges kn/16, kt/16; face diagonals (kn - kt)/16, kt/8; body diagonals (kn - kt)/12, kt/4; kappa d/16.
inline constexpr int cell_constants = 7;
/// Constants of a material in a table: those seven, then zero.
inline constexpr int table_constants = 8;
/// What the kernels make of them, cell_strip.cpp.
inline constexpr int prepared_constants = 19;

/// Cells of a strip, and elements of its rows of values.
inline constexpr std::int64_t strip_cells = 32;
/// Values of two node rows next to each other in z, per component: even and odd in x, each even and odd in z.
inline constexpr int pair_values = 4;

/// Rows of strip_cells values: `component c, value m` at [(pair_values c + m) strip_cells].
template <class T>
using PairValues = T[6 * pair_values * strip_cells];

/// Work space of a strip; aligned to 64 bytes.
template <class T>
struct alignas(64) Strip {
  PairValues<T> motion[2];  ///< of the node rows on the lower and the upper side in y of a row of cells
  PairValues<T> pending;    ///< what the node rows at the lower side have from the cells before
  PairValues<T> force;      ///< on these node rows, complete
  T constants[prepared_constants * strip_cells];
};

/// A row of nodes on a strip: pointer to component 0 of the node at the lower end in x of its first cell; the next
/// component lies `component` elements on.
template <class T>
struct NodeRow {
  T* at;
  std::ptrdiff_t component;
};

/// All functions work on `cells` cells, whole lines of 64 bytes; `components` 6 or 3; rotations are multiplied by
/// `half_d` on the way in and moments on the way out.
template <class T>
struct StripKernels {
  /// Constants of cells from a table by material, table_constants each, times their factors (null: 1). `tied` is 1, or
  /// 0 for cells whose uniform strain is not tied to their other motions (strain_tie.h).
  void (*prepare)(const std::uint16_t* material, const float* factor, const T* table, T tied, std::int64_t cells,
                  T* prepared);
  /// The same from rows of the seven constants, `pitch` elements apart.
  void (*prepare_rows)(const T* constants, std::ptrdiff_t pitch, T tied, std::int64_t cells, T* prepared);
  /// Values of two node rows next to each other in z. Reads one node beyond the strip.
  void (*transform)(int components, T half_d, const NodeRow<const T>& low, const NodeRow<const T>& high,
                    std::int64_t cells, T* values);
  /// Adds a row of cells: `force` becomes minus what is pending and what the cells add to the lower node rows;
  /// `pending` what they add to the upper ones.
  void (*cells)(int components, const T* constants, const T* lower, const T* upper, std::int64_t cells, T* pending,
                T* force);
  /// Forces of nodes from their values. A node also gets what the cell before it gives to its upper end, `carry` for
  /// the first one (low and high row by component, 6 each); `carry` becomes that of the strip's last cell.
  /// The high row is set; the low one is added to, or set if `first`.
  void (*deliver)(int components, T half_d, const T* values, std::int64_t cells, bool first, T* carry,
                  const NodeRow<T>& low, const NodeRow<T>& high);
};

/// Kernels for this processor.
template <class T>
const StripKernels<T>& strip_kernels();

}  // namespace koshi::mechanics
