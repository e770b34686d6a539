// Mean stress and strain of the solid phases.
#pragma once

#include <vector>

#include "base/exact_sum.h"
#include "koshi/homogenize.h"
#include "mechanics/cell_stress.h"

namespace koshi::homogenize {

/// Stress and strain of a cell are linear in the motion of its corners, and all cells of a material have the same
/// coefficients, times the factor of the cell: their sums are those of one cell that moves as the sum of all.
class PhaseSums {
 public:
  PhaseSums(const model::Model& model, const std::vector<Phase>& phases);
  /// Column j from the displacements of case j, ghosts set. Returns the mean stress [Pa] of the box, voids too; the
  /// bits are the same on ranks that do not cut the body across x (collective).
  mechanics::Tensor6 add(std::size_t j, const lattice::Field<double>& u);
  /// Of each solid phase; none where they are more than a hundred.
  const std::vector<PhaseMeans>& means() const { return means_; }

 private:
  /// Components of all corners, corner by corner: three displacements, three rotations.
  static constexpr std::size_t motions = 48;
  /// Adds the motions of `count` cells along x, from the one with index n on, each times its factor if `weighted`.
  void add_run(const lattice::Field<double>& u, std::int64_t n, std::int64_t count, bool weighted,
               std::vector<ExactSum>& sums, std::size_t at) const;

  const model::Model& model_;
  std::vector<std::size_t> slot_;  ///< by material
  std::vector<PhaseMeans> means_;
  std::vector<double> cells_;    ///< of each phase
  model::SpringLattice single_;  ///< one cell
};

}  // namespace koshi::homogenize
