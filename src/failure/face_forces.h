// What the closed crack faces of a body in motion carry, cell by cell.
#pragma once

#include <cstdint>
#include <vector>

#include "koshi/field.h"
#include "mechanics/cell_stress.h"

namespace koshi::failure {

/// Forces of stresses in few cells on their corners, kept by cell: rows of nodes far from these cost nothing.
class FaceForces {
 public:
  /// For cells that touch an owned node; the layout outlives this.
  explicit FaceForces(const lattice::Layout& layout);
  /// Memory for so many cells.
  void reserve(std::size_t cells) { cells_.reserve(cells); }

  /// begin(), then push() for cells in ascending order, then end(). `pull` [N] is -d^2/4 times the stress.
  void begin();
  void push(std::int64_t cell, const mechanics::Tensor6& pull);
  void end();

  /// Adds the forces on row (j, k) of owned nodes, force[c] pointing to node i = 0.
  void add(std::int64_t j, std::int64_t k, double* const* force) const;

 private:
  struct Cell {
    std::int64_t i;
    mechanics::Tensor6 pull;
  };
  const lattice::Layout& layout_;
  std::vector<Cell> cells_;
  std::vector<std::size_t> first_;  ///< of cells_, by row of cells, and one more
  std::size_t row_ = 0;             ///< rows before have their first_
};

}  // namespace koshi::failure
