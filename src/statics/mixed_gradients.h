// Conjugate gradients in single precision, corrected in double: equilibrium under a mean strain in little memory.
#pragma once

#include <memory>

#include "koshi/statics.h"
#include "mechanics/cell_stress.h"
#include "mechanics/force_kernel.h"
#include "statics/byte_field.h"
#include "statics/free_motions.h"
#include "statics/petsc.h"
#include "statics/preconditioner.h"

namespace koshi::statics {

/// Conjugate gradients in double precision keep six vectors of all unknowns beside the multigrid levels. Here the
/// residual, its image under the cycle and that of the search direction live in the three fields of the finest level,
/// whose operator in single precision is that of the body, and one more field holds the direction. Displacements are
/// summed in double precision. Each time the residual has fallen by a thousand it is taken anew from them, in double
/// precision, and the directions go on (van der Vorst and Ye 2000, SIAM J. Sci. Comput. 22, 835): the residual that
/// counts is the true one.
///
/// For one body and any number of mean strains; the model and the options must outlive it. All functions are
/// collective; the bits are the same on any ranks that do not cut the body across x.
class MixedGradients {
 public:
  MixedGradients(const model::Model& model, const StaticOptions& options);

  /// Whether the operator of the finest level is that of the body, in single precision with digits to spare: shared
  /// springs that hold all node rotations, no cut cells or springs to the ground, stiffness within a ratio of 1e4; and
  /// no PETSc options, which would ask for a method of PETSc's.
  static bool serves(const model::Model& model, const StaticOptions& options);

  /// Fills the displacements, ghosts too, with the equilibrium under a mean strain, nothing else pushing. It ends when
  /// the energy of what is missing is estimated as the tolerance times the energy by which u lies below u = E x, or at
  /// a residual (2-norm over the unknowns) of `absolute` [N]. Throws RunError when the iteration does not converge.
  SolveReport solve(const mechanics::Tensor6& mean_strain, double absolute, lattice::Field<double>& u);

  /// The periodic part u - E x, to two digits.
  ByteField kept(const mechanics::Tensor6& mean_strain, const lattice::Field<double>& u) const;
  /// Work [J] of the residual that the last solve has left on the periodic part of another one.
  double work(const ByteField& kept) const;

 private:
  /// level.b = -K u / unit_ on free components; its norm [N]. Ghosts of u set.
  double take_residual(const lattice::Field<double>& u);
  /// direction_ = level.x + beta direction_.
  void turn(float beta);
  /// u += alpha direction_, level.b -= alpha times its image; norm of level.b [N].
  double advance(double alpha, lattice::Field<double>& u);
  double product(const RowField<float>& a, const RowField<float>& b) const;
  template <class F>
  void for_each_row(F&& use) const;

  const model::Model& model_;
  const StaticOptions& options_;
  double start_;  ///< wall time at which the setup began [s]
  double setup_seconds_ = 0;
  PetscSession session_;
  std::unique_ptr<FreeMotions> free_;
  std::unique_ptr<Preconditioner> preconditioner_;
  mechanics::ForceKernel kernel_;
  double unit_ = 0;  ///< force that the level takes for 1 [N]
  RowField<float> direction_;
};

}  // namespace koshi::statics
