// Equilibrium that follows its cracks event by event (theory, section 12).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/exact_sum.h"
#include "driver/cracked_equilibrium.h"
#include "driver/simulation.h"
#include "driver/stop_criteria.h"
#include "failure/equilibrium_law.h"

namespace koshi::driver {
namespace {

/// Factor on all loads of a model, beside those at the end of their histories; undone at the end.
class LoadFactor {
 public:
  LoadFactor(model::Model& model, double t) : model_(model) {
    for (model::Load& load : model.loads) {
      before_.push_back(load.history);
      at_end_.push_back(model::factor(load.history, t));
    }
    set(1);
  }
  ~LoadFactor() {
    for (std::size_t l = 0; l < before_.size(); ++l) model_.loads[l].history = before_[l];
  }
  LoadFactor(const LoadFactor&) = delete;
  LoadFactor& operator=(const LoadFactor&) = delete;
  void set(double factor) {
    for (std::size_t l = 0; l < before_.size(); ++l) model_.loads[l].history = {{0, factor * at_end_[l]}};
  }

 private:
  model::Model& model_;
  std::vector<model::History> before_;
  std::vector<double> at_end_;
};

/// Two events are joined by a straight line of load over displacement: its work, and how much the body carries.
class PathWork {
 public:
  /// At an event: elastic energy, work of the supports' present forces on their present motions, and what cracks that
  /// closed or opened since the last one did to the work of the straight line [J].
  void add(double factor, double elastic, double of_supports, double bend) {
    const double force = of_supports / factor, motion = (2 * elastic - of_supports) / factor;
    work_ += bend + 0.5 * (force + force_) * (factor - factor_) + 0.5 * (factor + factor_) * (motion - motion_);
    force_ = force;
    motion_ = motion;
    factor_ = factor;
    by_motion_ = by_motion_ || of_supports != 0;
    unit_energy_ = elastic / (factor * factor);
    if (first_energy_ == 0) first_energy_ = unit_energy_;
  }
  double work() const { return work_; }
  /// Load, in units of its own: the force on moved supports, or the factor on given forces.
  double load() const { return by_motion_ ? std::abs(force_) : factor_; }
  /// Stiffness over that of the first event.
  double stiffness() const { return by_motion_ ? unit_energy_ / first_energy_ : first_energy_ / unit_energy_; }

 private:
  double work_ = 0, force_ = 0, motion_ = 0, factor_ = 0, unit_energy_ = 0, first_energy_ = 0;
  bool by_motion_ = false;
};

}  // namespace

// Work of the supports' forces on the motions of their nodes; the ground does not move.
double Simulation::work_of_supports() {
  const lattice::Field<double> reactions = meter_->reactions(*state_, false);
  ExactSum sum;
  for (const model::PrescribedMotion& motion : model_->motions)
    sum += reactions.component(motion.component)[motion.node] *
           state_->displacement.component(motion.component)[motion.node];
  sum.sum_ranks(model_->communicator);
  return sum.value();
}

failure::Fracturing& Simulation::restored_cracks() {
  failure::Fracturing& cracks = *fracturing();
  cracks.restore();
  return cracks;
}

statics::StaticOptions Simulation::crack_options(const Observer& observer,
                                                 const std::vector<std::string>& petsc_options) const {
  statics::StaticOptions options;
  options.tolerance = model_->definition.analysis.tolerance;
  options.petsc_options = petsc_options;
  options.progress = [&observer](int, double) {
    if (observer.breathe) observer.breathe();
  };
  return options;
}

mechanics::Measurement Simulation::measure_cracked(const failure::CrackContact& contact) {
  mechanics::Measurement measurement = meter_->measure(*state_, 0);
  const double carried = contact.energy();
  measurement.balance.elastic_energy += carried;
  measurement.balance.leapfrog_energy += carried;
  measurement.balance.cracked = fracturing()->energy_taken();
  return measurement;
}

Outcome Simulation::run_events(const Observer& observer, const std::vector<std::string>& petsc_options) {
  const model::Definition& definition = model_->definition;
  const statics::StaticOptions options = crack_options(observer, petsc_options);

  // The state is that of the unit load between events, when equilibria are sought, and of the event's load at them.
  failure::Fracturing& cracks = restored_cracks();
  const auto events = failure::follow_events(cracks, *model_, *state_);
  const double end = statics::end_time(definition);
  LoadFactor loads(*model_, end);
  CrackedEquilibrium equilibrium(*model_, *state_, events->contact(), end, options);

  Outcome outcome;
  CrackPath& path = outcome.path.emplace();
  PathWork balance;
  const auto sample = [&](double factor) {
    outcome.measurement = measure_cracked(events->contact());
    mechanics::Balance& measured = outcome.measurement.balance;
    if (factor > 0) balance.add(factor, measured.elastic_energy, work_of_supports(), events->contact().bend());
    measured.load_factor = factor;
    measured.given = balance.work();
    state_->time = static_cast<double>(path.events);
    if (observer.history) observer.history(outcome.measurement, *state_);
  };
  state_->displacement.zero();
  sample(0);

  // One broken layer leaves the whole its trace of stiffness times the layers there are.
  const Int3& cells = model_->lattice.grid.cells;
  const double parted =
      1.5 * failure::Fracturing::trace * static_cast<double>(std::max({cells[0], cells[1], cells[2]}));

  double factor = 1, peak = 0;
  for (bool changed = true;;) {
    if (changed) equilibrium.find();
    const double next = events->next();
    const bool over = !std::isfinite(next);
    if (!over) factor = next;
    events->go(factor);
    loads.set(factor);
    ++path.events;
    sample(factor);
    if (balance.load() > peak) {
      peak = balance.load();
      path.peak_event = path.events;
      path.peak_load_factor = factor;
    }
    outcome.stopped = observer.poll && observer.poll(*state_);
    outcome.stop_reason = reason_to_stop(*model_, *state_, outcome.measurement);
    path.reason = over                                        ? "nothing cracks any more"
                  : !outcome.stop_reason.empty()              ? outcome.stop_reason
                  : balance.stiffness() < parted              ? "the body has parted"
                  : path.events >= definition.analysis.events ? "number of events"
                  : outcome.stopped                           ? "stopped"
                                                              : "";
    const bool done = !path.reason.empty();
    const std::optional<int> every = definition.output.every_events;
    if (observer.fields && (done || (every && path.events % *every == 0))) observer.fields(*state_, 0);
    path.cracked = cracks.count_cells(0);
    if (observer.progress)
      observer.progress(
          static_cast<double>(path.events) / definition.analysis.events,
          fmt::format("event {}, load factor {:.4g}, {} cells cracked", path.events, factor, path.cracked));
    if (done) break;
    changed = events->soften();
    events->unload();
    loads.set(1);
  }
  outcome.solution = equilibrium.report();
  path.hierarchies = equilibrium.hierarchies();
  path.parted = cracks.count_cells(1);
  outcome.converged = true;
  state_->time = end;
  return outcome;
}

}  // namespace koshi::driver
