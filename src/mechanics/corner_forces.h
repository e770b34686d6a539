// Forces on the corners of single cells, beside those of the lattice.
#pragma once

#include <vector>

#include "koshi/field.h"
#include "koshi/grid.h"

namespace koshi::mechanics {

/// Marks the rows of owned nodes, j + owned()[1] k, that a cell has corners in; its index is that of its lowest corner.
void mark_rows(const lattice::Layout& layout, std::int64_t cell, std::vector<char>& rows);

/// A field of forces on nodes that few cells give, with the rows that they reach.
class CornerForces {
 public:
  /// Both outlive this.
  CornerForces(const lattice::Layout& layout, lattice::Field<double>& force);

  /// The cell may give forces from now on.
  void reach(std::int64_t cell) { mark_rows(layout_, cell, rows_); }
  /// No cell does; the forces are left as they are.
  void forget();
  /// Forces on the corners of the cell are zero.
  void clear(std::int64_t cell);
  /// Adds the forces on row (j, k) of owned nodes, force[c] pointing to node i = 0.
  void add(std::int64_t j, std::int64_t k, double* const* force) const;

 private:
  const lattice::Layout& layout_;
  lattice::Field<double>& force_;
  std::vector<char> rows_;  ///< of owned nodes
};

}  // namespace koshi::mechanics
