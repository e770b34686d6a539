#include "koshi/statics.h"

#include <algorithm>

#include "statics/borrowed.h"
#include "statics/macroscopic.h"
#include "statics/static_solver.h"

namespace koshi::statics {

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
  if (definition.macroscopic) last(definition.macroscopic->history);
  return t;
}

SolveReport solve_static(const model::Model& model, model::State& state, const StaticOptions& options) {
  state.time = end_time(model.definition);
  state.mean_strain = {};
  if (model.definition.macroscopic) return solve_macroscopic(model, state, options);
  // Velocities are zero at rest: their memory holds the right-hand side, that of the displacements the operand of K.
  Borrowed right_hand_side(state.velocity);
  StaticSolver solver(model, state.time, state.displacement, options);
  solver.equilibrium().right_hand_side(right_hand_side.data());
  solver.free().require_balance(right_hand_side.data());
  return solver.solve(right_hand_side.data(), 0, state.displacement);
}

}  // namespace koshi::statics
