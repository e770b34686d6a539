#include "driver/simulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "base/collective.h"
#include "base/out_of_memory.h"
#include "driver/schedule.h"
#include "driver/stop_criteria.h"
#include "driver/warnings.h"
#include "failure/bond_breaking.h"
#include "failure/cracking.h"
#include "koshi/dynamics.h"
#include "koshi/input.h"

namespace koshi::driver {

using Type = model::AnalysisDefinition::Type;

namespace {

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

bool wants_orientation(const model::Definition& definition) {
  const auto& fields = definition.output.fields;
  return std::find(fields.begin(), fields.end(), "orientation") != fields.end();
}

}  // namespace

model::Model load_model(const model::Definition& definition, const Communicator& communicator) {
  // A file may be missing on one machine only.
  std::optional<model::Definition> loaded;
  collectively(communicator, [&] { loaded = io::load_files(definition); });
  return model::make_model(*loaded, communicator);
}

Simulation::Simulation(const model::Definition& definition, const Communicator& communicator)
    : memory_before_(resident_memory(communicator)),
      model_(while_making("the model",
                          [&] { return std::make_unique<model::Model>(load_model(definition, communicator)); })),
      kernel_(std::make_unique<mechanics::ForceKernel>(model_->lattice)),
      meter_(std::make_unique<mechanics::Meter>(*model_, *kernel_)) {}

model::State& Simulation::state() {
  if (state_) return *state_;
  state_ = while_making("displacements and velocities", [&] { return std::make_unique<model::State>(*model_); });
  if (wants_orientation(model_->definition) && model_->components() == 6) {
    state_->orientation = lattice::Field<double>(model_->layout(), 4);
    std::fill_n(state_->orientation.component(0), state_->orientation.stride(), 1.0);
  }
  return *state_;
}

const std::vector<std::string>& Simulation::prepare() {
  if (warnings_) return *warnings_;
  std::vector<std::string> found = warnings(*model_);
  const Type type = model_->definition.analysis.type;
  if (type == Type::quasi_static) check_support();
  if (type == Type::modes) modes::free_motions(*model_, model_->definition.analysis);
  if (model_->definition.analysis.stepped()) time_step();
  return warnings_.emplace(std::move(found));
}

Outcome Simulation::run(const Observer& observer, const std::vector<std::string>& petsc_options) {
  const double start = now();
  prepare();
  stepper_.reset();
  state();
  const Type type = model_->definition.analysis.type;
  Outcome outcome = model_->definition.follows_events()          ? run_events(observer, petsc_options)
                    : model_->definition.cracks_in_equilibrium() ? run_load_steps(observer, petsc_options)
                    : type == Type::statics                      ? run_static(observer, petsc_options)
                    : type == Type::modes                        ? run_modes(observer)
                                                                 : run_explicit(observer);
  lag_ = outcome.time_step;
  outcome.seconds = now() - start;
  return outcome;
}

failure::Fracturing* Simulation::fracturing() {
  if (fracturing_ || !model_->definition.cracks()) return fracturing_.get();
  if (model_->definition.breaks_bonds())
    fracturing_ = std::make_unique<failure::BondBreaking>(*model_, state());
  else
    fracturing_ = std::make_unique<failure::Cracking>(*model_, state());
  return fracturing_.get();
}

mechanics::Meter& Simulation::meter() {
  if (fracturing_) fracturing_->lay_forces();
  return *meter_;
}

// Balance and probes, with the energies of cracks.
mechanics::Measurement Simulation::measure_at(double dt) {
  mechanics::Measurement measurement = meter().measure(state(), dt);
  if (fracturing() != nullptr) fracturing()->complete(measurement.balance);
  return measurement;
}

Outcome Simulation::run_static(const Observer& observer, const std::vector<std::string>& petsc_options) {
  statics::StaticOptions options;
  options.tolerance = model_->definition.analysis.tolerance;
  options.petsc_options = petsc_options;
  options.progress = [&](int iteration, double residual) {
    if (observer.progress)
      observer.progress(std::clamp(std::log(residual) / std::log(options.tolerance), 0.0, 1.0) + 0.0,
                        fmt::format("iteration {}, residual {:.1e}", iteration, residual));
    if (observer.breathe) observer.breathe();
  };
  options.stop = [&] { return observer.poll && observer.poll(*state_); };
  Outcome outcome;
  outcome.solution = statics::solve_static(*model_, *state_, options);
  outcome.converged = outcome.solution->converged;
  outcome.stopped = outcome.solution->stopped;
  outcome.measurement = meter_->measure(*state_, 0);
  if (outcome.stopped) return outcome;
  if (observer.history) observer.history(outcome.measurement, *state_);
  if (observer.fields) observer.fields(*state_, 0);
  return outcome;
}

Outcome Simulation::run_modes(const Observer& observer) {
  const model::AnalysisDefinition& analysis = model_->definition.analysis;
  modes::ModesOptions options;
  options.progress = [&](int iteration, int found, double residual) {
    if (observer.progress) {
      // Each mode found is a part of the work, and so is the way of the worst one to its residual.
      const double way = std::clamp(std::log(residual) / (0.5 * std::log(analysis.tolerance)), 0.0, 1.0) + 0.0;
      observer.progress(std::max(way, static_cast<double>(found) / analysis.count) * 0.99,
                        fmt::format("iteration {}, {} modes, residual {:.1e}", iteration, found, residual));
    }
    if (observer.breathe) observer.breathe();
    return !(observer.poll && observer.poll(*state_));
  };
  Outcome outcome;
  outcome.modes = modes::find_modes(*model_, options);
  outcome.stopped = outcome.modes->stopped;
  for (const modes::Mode& mode : outcome.modes->modes) {
    modes::fill(*model_, mode, state_->displacement);
    state_->time = mode.number;
    if (observer.fields) observer.fields(*state_, 0);
  }
  // The state is the body at rest again: a mode has no size of its own.
  state_->displacement.zero();
  state_->time = 0;
  return outcome;
}

void Simulation::check_support() const {
  // Nothing carries a periodic body away that its mean strain alone loads.
  const model::Definition& definition = model_->definition;
  if (definition.macroscopic && definition.loads.empty()) return;
  const bool held = model_->communicator.any(!model_->lattice.ground.empty());
  if (model_->motion_count == 0 && !held)
    throw InputError(
        definition.places.find("analysis.type"),
        "a quasi-static run needs a support, but nothing is fixed or prescribed; add a [[boundary]], or use type = "
        "\"dynamic\"");
}

double Simulation::choose_step(const mechanics::StableStep& stable) const {
  const model::AnalysisDefinition& analysis = model_->definition.analysis;
  check_step_count(model_->definition, analysis.time_step.value_or(analysis.safety * stable.limit()));
  if (!analysis.time_step) return analysis.safety * stable.limit();
  if (*analysis.time_step > stable.limit() && !analysis.allow_unstable_step)
    throw InputError(
        model_->definition.places.find("analysis.time_step"),
        fmt::format("time step {:.4g} s is above the stable limit {:.4g} s (the lesser of d/c_p = {:.4g} s and "
                    "2/omega_max, with damping, = "
                    "{:.4g} s); use time_step = \"auto\" or at most {:.3g} s, or allow_unstable_step = true",
                    *analysis.time_step, stable.limit(), stable.wave, stable.frequency,
                    analysis.safety * stable.limit()));
  return *analysis.time_step;
}

void Simulation::check_divergence(const mechanics::Balance& balance, const Observer& observer) const {
  // A body that has moved a thousand times its size is no answer, and soon no number.
  const Vec3& size = model_->definition.body.size;
  const double bound = 1e3 * std::max({size[0], size[1], size[2]});
  double largest = 0;
  Int3 where{};
  lattice::for_each_owned(model_->layout(), [&](auto i, auto j, auto k, auto n) {
    for (int c = 0; c < 3; ++c) {
      double u = std::abs(state_->displacement.component(c)[n]);
      if (std::isnan(u)) u = std::numeric_limits<double>::infinity();
      if (u <= largest) continue;
      largest = u;
      where = model_->layout().global({i, j, k});
    }
  });
  const bool finite = std::isfinite(balance.elastic_energy) && std::isfinite(balance.kinetic_energy);
  if (!model_->communicator.any(!finite || !(largest < bound))) return;
  // The rank with the largest displacement tells the others where.
  const Communicator& communicator = model_->communicator;
  const bool here = largest == communicator.max(largest);
  const int rank = static_cast<int>(communicator.min(here ? communicator.rank() : communicator.size() - 1));
  const Vec3 own = model_->lattice.grid.position(where);
  std::array<double, 4> at{own[0], own[1], own[2], largest};
  communicator.broadcast(at, rank);
  const double dt = state_->step > 0 ? state_->time / static_cast<double>(state_->step) : 0;
  const lattice::Grid& grid = model_->lattice.grid;
  const auto index = [&](std::size_t a) { return std::llround((at[a] - grid.origin[a]) / grid.d); };
  const std::string moved = std::isfinite(at[3]) ? fmt::format("has moved {:.3g} m", at[3]) : "is nowhere any more";
  const std::string kept = observer.diverged ? observer.diverged(*state_) : "";
  throw RunError(fmt::format(
      "the run diverged at or before step {} (t = {:.6g} s): node ({}, {}, {}) at ({:.4g}, {:.4g}, {:.4g}) m "
      "{}; use a smaller time_step than {:.3g} s (or \"auto\"), or check loads and units{}",
      state_->step, state_->time, index(0), index(1), index(2), at[0], at[1], at[2], moved, dt, kept));
}

Outcome Simulation::run_explicit(const Observer& observer) {
  const model::AnalysisDefinition& analysis = model_->definition.analysis;
  const bool quasi_static = analysis.type == Type::quasi_static;
  Outcome outcome;
  outcome.stable = stable_;
  const bool goes_on = state_->step > 0 && state_->time_step > 0;
  if (goes_on) check_step_count(model_->definition, state_->time_step);
  const Schedule schedule(model_->definition, goes_on ? state_->time_step : choose_step(*outcome.stable), goes_on);
  outcome.time_step = state_->time_step = schedule.dt();

  // The state may have been changed since it was cracked: by a restart, by its owner.
  if (fracturing() != nullptr) fracturing()->restore();
  dynamics::ExplicitSolver solver(*model_, *state_, schedule.dt(), fracturing());
  outcome.measurement = measure_at(schedule.dt());
  if (state_->step == 0) {
    if (observer.history) observer.history(outcome.measurement, *state_);
    if (observer.fields && schedule.samples_fields()) observer.fields(*state_, schedule.dt());
  }
  outcome.converged = !quasi_static;
  while (state_->step < schedule.last_step() && !outcome.stopped) {
    solver.step();
    if (observer.breathe) observer.breathe();
    const std::int64_t step = state_->step;
    const bool last = step == schedule.last_step();
    if (schedule.is_check(step) || schedule.is_history(step) || last) {
      outcome.measurement = measure_at(schedule.dt());
      check_divergence(outcome.measurement.balance, observer);
      outcome.converged = !quasi_static || schedule.at_rest(outcome.measurement.balance, state_->time);
    }
    if (schedule.is_history(step)) outcome.stop_reason = reason_to_stop(*model_, *state_, outcome.measurement);
    const bool done = last || (quasi_static && outcome.converged) || !outcome.stop_reason.empty();
    if (observer.history && (done || schedule.is_history(step))) observer.history(outcome.measurement, *state_);
    if (observer.fields && (done || schedule.is_field(step))) observer.fields(*state_, schedule.dt());
    if (observer.progress && (done || schedule.is_poll(step)))
      observer.progress(schedule.fraction(step, outcome.measurement.balance),
                        fmt::format("step {}, t = {:.4g} s, unbalanced {:.1e}", step, state_->time,
                                    outcome.measurement.balance.unbalanced_ratio()));
    if (done) break;
    if (observer.poll && schedule.is_poll(step)) outcome.stopped = observer.poll(*state_);
  }
  outcome.steps = state_->step;
  return outcome;
}

}  // namespace koshi::driver
