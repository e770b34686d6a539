#include "koshi/statics.h"

#include <algorithm>

#include "statics/static_solver.h"

namespace koshi::statics {
namespace {

/// Memory of the state that waits for its values until the end; all zero again when this is gone.
class Borrowed {
 public:
  explicit Borrowed(lattice::Field<double>& field) : field_(field) {}
  ~Borrowed() { field_.zero(); }
  Borrowed(const Borrowed&) = delete;
  Borrowed& operator=(const Borrowed&) = delete;
  double* data() { return field_.data(); }

 private:
  lattice::Field<double>& field_;
};

}  // namespace

double end_time(const model::Definition& definition) {
  if (definition.analysis.duration) return *definition.analysis.duration;
  double t = 0;
  const auto last = [&t](const model::History& history) {
    if (!history.empty()) t = std::max(t, history.back()[0]);
  };
  for (const auto& load : definition.loads) last(load.history);
  for (const auto& boundary : definition.boundaries) {
    last(boundary.history);
    t = std::max(t, boundary.ramp);
  }
  return t;
}

SolveReport solve_static(const model::Model& model, model::State& state, const StaticOptions& options) {
  state.time = end_time(model.definition);
  // Velocities are zero at rest: their memory holds the right-hand side, that of the displacements the operand of K.
  Borrowed right_hand_side(state.velocity);
  StaticSolver solver(model, state.time, state.displacement, options);
  solver.equilibrium().right_hand_side(right_hand_side.data());
  solver.free().require_balance(right_hand_side.data());
  return solver.solve(right_hand_side.data(), 0, state.displacement);
}

}  // namespace koshi::statics
