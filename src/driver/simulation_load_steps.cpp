// Equilibrium that goes through the histories in steps, with the cracks of each (theory, section 12).
#include <fmt/format.h>

#include <cmath>

#include "driver/cracked_equilibrium.h"
#include "driver/simulation.h"
#include "driver/step_work.h"
#include "driver/stop_criteria.h"
#include "failure/equilibrium_law.h"

namespace koshi::driver {
namespace {

// A step has come to its end when nothing is off its limit by more than this part of it.
constexpr double close = 1e-3;

}  // namespace

Outcome Simulation::run_load_steps(const Observer& observer, const std::vector<std::string>& petsc_options) {
  const model::Definition& definition = model_->definition;
  const int count = *definition.analysis.steps;
  const double duration = statics::end_time(definition);
  const statics::StaticOptions options = crack_options(observer, petsc_options);

  failure::Fracturing& fracture = restored_cracks();
  state_->displacement.zero();
  const auto cracks = failure::follow_steps(fracture, *model_, *state_);
  CrackedEquilibrium equilibrium(*model_, *state_, cracks->contact(), duration, options);
  StepWork work(*model_, *meter_);

  Outcome outcome;
  CrackPath& path = outcome.path.emplace();
  const auto sample = [&](double given) {
    outcome.measurement = measure_cracked(cracks->contact());
    outcome.measurement.balance.given = given;
    if (observer.history) observer.history(outcome.measurement, *state_);
  };

  // The first row is the body at rest, before anything acts on it.
  state_->time = 0;
  sample(0);
  for (bool done = false; !done;) {
    const double before = state_->time, t = duration * static_cast<double>(path.steps + 1) / count;
    cracks->begin();
    equilibrium.set_time(t);
    state_->time = t;
    // Equilibrium and damage in turn, until they go together.
    int equilibria = 0;
    for (;;) {
      equilibrium.find();
      ++equilibria;
      const double off = cracks->look();
      if (off <= close || cracks->fly()) break;
      if (equilibria == most_equilibria_) {
        path.endless = fmt::format(
            "step {} of {} (t = {:.6g} s) finds no end: after {} equilibria a cell or a bond is still off its limit by "
            "{:.1e} of it; take smaller steps (more analysis.steps), or follow cracks event by event (without steps)",
            path.steps + 1, count, t, equilibria, off);
        break;
      }
      cracks->take();
    }
    const bool endless = !path.endless.empty();
    if (!endless) ++path.steps;
    if (endless || cracks->fly()) {
      // The run ends where the step before has.
      cracks->undo();
      state_->time = before;
      path.reason = endless ? "a step without an end" : fmt::format("the body has parted in step {}", path.steps);
      done = true;
    } else {
      cracks->end();
      sample(work.add(*state_, cracks->contact().bend()));
      outcome.stopped = observer.poll && observer.poll(*state_);
      outcome.stop_reason = reason_to_stop(*model_, *state_, outcome.measurement);
      path.reason = !outcome.stop_reason.empty() ? outcome.stop_reason
                    : path.steps == count        ? "the end of the histories"
                    : outcome.stopped            ? "stopped"
                                                 : "";
      done = !path.reason.empty();
    }
    path.cracked = fracture.count_cells(0);
    const double every = definition.output.every.value_or(0);
    const auto samples = [every](double time) { return std::floor(time / every + 1e-9); };
    if (observer.fields && (done || (every > 0 && samples(t) > samples(before)))) observer.fields(*state_, 0);
    if (observer.progress)
      observer.progress(
          static_cast<double>(path.steps) / count,
          fmt::format("step {} of {}, {} equilibria, {} cells cracked", path.steps, count, equilibria, path.cracked));
  }
  outcome.solution = equilibrium.report();
  path.equilibria = equilibrium.solves();
  path.hierarchies = equilibrium.hierarchies();
  path.parted = fracture.count_cells(1);
  return outcome;
}

}  // namespace koshi::driver
