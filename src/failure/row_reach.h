// How far the nodes around a row of cells may move before one of the cells can be at its limit.
#pragma once

#include <array>
#include <vector>

#include "failure/strain_rows.h"
#include "koshi/spring_lattice.h"

namespace koshi::failure {

/// Rows of cells that touch an owned node, (-1, -1) first.
inline std::size_t cell_row(const lattice::Layout& layout, std::int64_t j, std::int64_t k) {
  return static_cast<std::size_t>((j + 1) + (layout.owned()[1] + 1) * (k + 1));
}

/// Keeps a length for each row of cells and takes off what the nodes around it move in a step. A motion that all of
/// them have in common strains no cell and does not count (theory, 12, "And when to look").
class RowReach {
 public:
  /// Both outlive this.
  RowReach(const model::SpringLattice& lattice, const lattice::Field<double>& velocity);

  /// Rows of cells that count, by cell_row(); of these nothing is left.
  void keep(const std::vector<char>& rows);
  void forget();
  /// Looks at the velocities of row (j, k) of owned nodes now instead of at spend().
  void note(std::int64_t j, std::int64_t k);
  /// Takes off the ways in a step of dt [s]; ghosts of the velocities must be up to date.
  void spend(double dt);
  /// Whether a cell of the row may be at its limit.
  bool is_spent(std::size_t cell_row) const { return kept_[cell_row] != 0 && !(reach_[cell_row] > 0); }
  void set(std::size_t cell_row, double reach) { reach_[cell_row] = reach; }

 private:
  /// The least and the largest velocity of a row of nodes, component by component [m/s].
  struct Range {
    Vec3 low, high;
  };
  std::size_t node_row(std::int64_t j, std::int64_t k) const {
    return static_cast<std::size_t>((j + 1) + (lattice_.layout.owned()[1] + 2) * (k + 1));
  }
  void look(std::int64_t j, std::int64_t k, std::int64_t begin, std::int64_t end);
  void add_ends(std::int64_t j, std::int64_t k);

  const model::SpringLattice& lattice_;
  const lattice::Field<double>& velocity_;
  const StrainRows& rows_ = strain_rows();
  bool whole_;                 ///< rows of the body: their nodes are all owned
  std::vector<char> kept_;     ///< by cell_row()
  std::vector<double> reach_;  ///< the same [m]
  std::vector<Range> range_;   ///< of rows of nodes, (-1, -1) first
  std::vector<char> wanted_;   ///< the same: beside a row of cells that counts
  std::vector<char> noted_;    ///< the same: range_ is that of this step
};

}  // namespace koshi::failure
