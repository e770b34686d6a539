// Conjugate gradients with the multigrid cycle, for one body and any number of right-hand sides.
#pragma once

#include <memory>

#include "koshi/statics.h"
#include "statics/equilibrium.h"
#include "statics/free_motions.h"
#include "statics/petsc.h"
#include "statics/preconditioner.h"

namespace koshi::statics {

/// Keeps the equations, the free motions and the multigrid hierarchy of a model, which must outlive it, as must `work`
/// and the options. Everything is collective.
class StaticSolver {
 public:
  /// `t`: time [s] of loads and prescribed motions. `work` is memory for one field; it may be the field that solve()
  /// fills.
  StaticSolver(const model::Model& model, double t, lattice::Field<double>& work, const StaticOptions& options);

  Equilibrium& equilibrium() { return equilibrium_; }
  const FreeMotions& free() const { return free_; }

  /// Fills the displacements, ghosts too, with the solution of K u = b, free motions taken out of both; starts from
  /// zero. It also ends at a residual (2-norm over the unknowns) of `absolute` [N], where that is above 0. Throws
  /// RunError when the iteration does not converge.
  SolveReport solve(double* right_hand_side, double absolute, lattice::Field<double>& displacement) {
    return solve(right_hand_side, absolute, displacement, false);
  }
  /// The same from where the displacements are, which are not the field `work`. It also ends at a residual of rounding
  /// size, as the largest right-hand side of all calls has it, and reports residuals relative to no less.
  SolveReport improve(double* right_hand_side, lattice::Field<double>& displacement) {
    return solve(right_hand_side, 0, displacement, true);
  }
  /// Makes the multigrid hierarchy anew, from the factors that the cells have by now.
  void refresh();

 private:
  SolveReport solve(double* right_hand_side, double absolute, lattice::Field<double>& displacement, bool from_there);

  const model::Model& model_;
  const StaticOptions& options_;
  double start_;  ///< wall time at which the setup began [s]
  double setup_seconds_ = 0;
  double largest_ = 0;  ///< 2-norm of the right-hand sides of improve() [N]
  PetscSession session_;
  Equilibrium equilibrium_;
  FreeMotions free_;
  std::unique_ptr<Preconditioner> preconditioner_;
};

}  // namespace koshi::statics
