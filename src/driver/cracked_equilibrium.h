// Equilibria of a body that loses springs and whose cracks close and open, one after the other.
#pragma once

#include <memory>
#include <vector>

#include "failure/equilibrium_law.h"
#include "koshi/statics.h"
#include "statics/static_solver.h"

namespace koshi::driver {

/// A solver that goes on from where the displacements are, and keeps its levels as long as they are worth it.
/// Everything is collective; model, state, contact and options must outlive it.
class CrackedEquilibrium {
 public:
  /// `t`: time [s] of loads and prescribed motions. Throws RunError for loads that nothing balances.
  CrackedEquilibrium(model::Model& model, model::State& state, failure::CrackContact& contact, double t,
                     const statics::StaticOptions& options);

  /// Takes loads and prescribed motions at another time [s] from now on. Throws as the constructor.
  void set_time(double t);

  /// Brings the displacements to the equilibrium of the springs of now, with every crack closed or open as they say,
  /// and the forces of cracks to these. Throws RunError when the solver or the cracks do not come to an end.
  void find();

  /// Of the first solve, with the iterations and seconds of all.
  const statics::SolveReport& report() const { return report_; }
  /// Solves so far.
  std::int64_t solves() const { return solves_; }
  /// Times that the levels were made.
  std::int64_t hierarchies() const { return hierarchies_; }

 private:
  void solve();
  void make_levels();

  model::State& state_;
  failure::CrackContact& contact_;
  lattice::Field<double> work_;
  std::vector<double> right_hand_side_;
  std::unique_ptr<statics::StaticSolver> solver_;
  statics::SolveReport report_;
  std::int64_t solves_ = 0, hierarchies_ = 1;
  int least_ = 0, extra_ = 0;  ///< iterations of the first solve with these levels, and what later ones took more
};

}  // namespace koshi::driver
