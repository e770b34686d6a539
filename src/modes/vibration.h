// The eigenvalue problem of free vibration on one rank's nodes.
#pragma once

#include <vector>

#include <Eigen/Cholesky>

#include "statics/equilibrium.h"
#include "statics/free_motions.h"
#include "statics/preconditioner.h"

namespace koshi::modes {

/// K x = omega^2 M x with the lumped masses M, as the symmetric problem A y = lambda y of numbers about one:
/// y = R x, R = sqrt(M / m), A = R^-1 K R^-1 / k and omega^2 = lambda k / m, with a mass m and a stiffness k of one
/// cell. Unknowns as in statics::Equilibrium; fixed components and nodes without a cell are zero. Rigid motions that
/// nothing holds are no vibrations: everything here stays orthogonal to them.
class Vibration {
 public:
  /// `work`: memory for one field (collective).
  Vibration(const model::Model& model, lattice::Field<double>& work);

  std::int64_t size() const { return equilibrium_.size(); }
  /// A y (collective).
  void apply(const double* y, double* Ay);
  /// z close to A^-1 r: one multigrid cycle, symmetric and positive, without rigid motions (collective).
  void precondition(const double* r, double* z);
  /// Start vector `number`: noise that depends on global nodes alone, smooth or not (collective).
  void start(int number, bool smooth, double* y);
  /// Takes the free motions out of displacements x, orthogonal in the masses (collective).
  void project(double* x);
  /// omega^2 [1/s^2] of an eigenvalue of A.
  double omega_squared(double lambda) const { return lambda * stiffness_ / mass_; }

  const statics::FreeMotions& free() const { return free_; }
  const statics::Preconditioner& preconditioner() const { return preconditioner_; }
  /// sqrt(M / m) of every unknown; zero where it cannot move.
  const std::vector<double>& root() const { return root_; }
  double mass() const { return mass_; }

 private:
  const model::Model& model_;
  double mass_ = 0;       ///< m [kg]
  double stiffness_ = 0;  ///< k [N/m]
  statics::Equilibrium equilibrium_;
  statics::FreeMotions free_;
  statics::Preconditioner preconditioner_;
  std::vector<double> root_, inverse_root_, scaled_;
  std::vector<Eigen::LLT<Eigen::MatrixXd>> gram_;  ///< of each free part's motions in the masses
};

}  // namespace koshi::modes
