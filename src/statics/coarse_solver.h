// The coarsest level, assembled and factored.
#pragma once

#include "statics/level.h"
#include "statics/petsc.h"

namespace koshi::statics {

/// Solves K x = b of a level on one rank with PETSc: Cholesky's factorisation of the assembled matrix. PETSc options
/// with prefix "coarse_" reach it.
class CoarseSolver {
 public:
  /// `shift` is added to the diagonal, relative to it: above zero for bodies that can move as a whole.
  CoarseSolver(const Level& level, double shift);
  /// level.x = K^-1 level.b.
  void solve(Level& level);

 private:
  PetscMat matrix_;
  PetscVec b_, x_;
  PetscKsp solver_;
};

}  // namespace koshi::statics
