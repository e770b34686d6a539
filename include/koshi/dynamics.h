// Explicit motion of the lattice.
#pragma once

#include <memory>

#include "koshi/model.h"

namespace koshi::failure {
class Fracturing;
}

namespace koshi::dynamics {

/// Steps displacements and rotations by central differences (N5, N6) with damping (N1, N27), loads and prescribed
/// motion. The state's velocities belong to the middle of the step before its time. All functions are collective.
class ExplicitSolver {
 public:
  /// `dt` [s] > 0; stability is the caller's concern (see mechanics::stable_step). Model and state must outlive the
  /// solver. A state at time 0 first takes the prescribed displacements of that time.
  /// `cracking`: follows the cracks of a body that can crack; it too must outlive the solver.
  ExplicitSolver(const model::Model& model, model::State& state, double dt, failure::Fracturing* cracking = nullptr);
  ~ExplicitSolver();

  void step();        ///< one step of dt
  double dt() const;  ///< [s]

 private:
  struct Implementation;
  std::unique_ptr<Implementation> self_;
};

}  // namespace koshi::dynamics
