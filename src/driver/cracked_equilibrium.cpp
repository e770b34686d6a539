#include "driver/cracked_equilibrium.h"

#include <fmt/format.h>

#include <algorithm>

namespace koshi::driver {
namespace {

// Levels of the solver are made anew when old ones have cost so many iterations more than new ones would have.
constexpr int patience = 60;
// Cracks close and open until all of them are as the displacements say; that takes a few rounds.
constexpr int most_rounds = 100;

}  // namespace

CrackedEquilibrium::CrackedEquilibrium(model::Model& model, model::State& state, failure::CrackContact& contact,
                                       double t, const statics::StaticOptions& options)
    : state_(state),
      contact_(contact),
      work_(model.layout(), model.components()),
      right_hand_side_(static_cast<std::size_t>(model.layout().owned_count() * model.components())) {
  contact.make_levels([&] { solver_ = std::make_unique<statics::StaticSolver>(model, t, work_, options); });
  set_time(t);
  solver_->equilibrium().add(contact.forces());
}

void CrackedEquilibrium::set_time(double t) {
  solver_->equilibrium().set_time(t);
  solver_->equilibrium().right_hand_side(right_hand_side_.data());
  solver_->free().require_balance(right_hand_side_.data());
}

void CrackedEquilibrium::find() {
  int rounds = 0;
  do {
    if (++rounds > most_rounds)
      throw RunError(
          fmt::format("cracks still close and open after {} equilibria of the same springs; a smaller "
                      "tolerance than {:.1e} or finer cells may help",
                      most_rounds, report_.relative_residual));
    solve();
  } while (contact_.look());
  // The solver left the forces of its last search direction.
  contact_.forces().update(state_.displacement);
}

void CrackedEquilibrium::solve() {
  if (contact_.ask_for_levels()) make_levels();
  // It holds forces of prescribed motions, by springs that may be gone.
  solver_->equilibrium().right_hand_side(right_hand_side_.data());
  const statics::SolveReport report = solver_->improve(right_hand_side_.data(), state_.displacement);
  if (++solves_ == 1) {
    report_ = report;
    return;
  }
  report_.iterations += report.iterations;
  report_.relative_residual = report.relative_residual;
  report_.solve_seconds += report.solve_seconds;
  // The first solve with new levels tells what they cost.
  if (least_ == 0) least_ = std::max(report.iterations, 1);
  extra_ += std::max(report.iterations - least_, 0);
  if (extra_ > patience) make_levels();
}

void CrackedEquilibrium::make_levels() {
  contact_.make_levels([this] { solver_->refresh(); });
  ++hierarchies_;
  least_ = extra_ = 0;
}

}  // namespace koshi::driver
