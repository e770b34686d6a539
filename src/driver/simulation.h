// One analysis from its definition to its end, without files: the schedule of samples, checks and stops.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "base/memory.h"
#include "driver/crack_path.h"
#include "failure/fracturing.h"
#include "koshi/dynamics.h"
#include "koshi/model.h"
#include "koshi/modes.h"
#include "koshi/statics.h"
#include "mechanics/measure.h"
#include "mechanics/stable_step.h"

namespace koshi::failure {
class CrackContact;
}  // namespace koshi::failure

namespace koshi::driver {

/// How an analysis went.
struct Outcome {
  std::int64_t steps = 0;                        ///< explicit steps
  double time_step = 0;                          ///< [s]
  std::optional<mechanics::StableStep> stable;   ///< explicit analyses
  std::optional<statics::SolveReport> solution;  ///< static analyses
  std::optional<modes::ModesReport> modes;       ///< of a search for modes
  std::optional<CrackPath> path;                 ///< static analyses that follow cracks
  bool converged = true;                         ///< quasi-static: the tolerance was reached
  std::string stop_reason;                       ///< why analysis.stop_when ended it; empty: it did not
  bool stopped = false;                          ///< the observer asked to stop; a static analysis has not converged
  double seconds = 0;                            ///< wall time of stepping or solving
  mechanics::Measurement measurement;            ///< at the end; empty for modes
};

/// What happens on the way; each may be empty. All are called on all ranks.
struct Observer {
  /// A row of the history: at the start, at regular intervals and at the end.
  std::function<void(const mechanics::Measurement&, model::State&)> history;
  /// A sample of the fields: at multiples of output.every and at the end, or one for each mode, whose number stands for
  /// the time. `dt` as in Meter.
  std::function<void(model::State&, double dt)> fields;
  /// Part of the work done (negative: unknown) and a few words.
  std::function<void(double, const std::string&)> progress;
  /// Called every few steps, in a static analysis after each iteration; true stops the run. While iterations go on the
  /// state is not defined; once stopped its displacements are those of the last iteration.
  std::function<bool(model::State&)> poll;
  /// Called after every step or iteration, by each rank for itself; may throw to end the run.
  std::function<void()> breathe;
  /// The run has diverged and is about to end with RunError; what it returns is added to the message.
  std::function<std::string(model::State&)> diverged;
};

/// The model of a definition, files that it names read first (collective).
model::Model load_model(const model::Definition& definition, const Communicator& communicator);

/// A model with its state, ready to run.
class Simulation {
 public:
  Simulation(const model::Definition& definition, const Communicator& communicator);

  /// Finds what only the built model shows to be wrong (collective): throws InputError for springs that are unstable, a
  /// time step that is not stable or a quasi-static body without support. Returns what the user should look at
  /// (driver/warnings.h). `run` does it too; before files are made is the time for it.
  const std::vector<std::string>& prepare();

  /// Runs the analysis of the definition from the present state to its end. Throws InputError as `prepare`, RunError
  /// when the run diverges or does not converge.
  Outcome run(const Observer& observer, const std::vector<std::string>& petsc_options = {});

  /// Explicit steps outside a run, whatever the type of the analysis (collective). `breathe` as in Observer.
  void step(std::int64_t count, const std::function<void()>& breathe = {});
  /// The step of `step` [s] (collective): the one the analysis names, else its safety times the stable limit.
  double time_step();
  /// Balance and probes of the present state (collective).
  mechanics::Measurement measure();

  /// From now on the load is `value` times its definition, whatever its history. Errors: InputError for an unknown
  /// name.
  void set_load_factor(const std::string& name, double value);
  /// From now on the boundary's motion is `value` times its definition, whatever its ramp and history.
  void set_boundary_factor(const std::string& name, double value);

  /// Throws InputError where no material can crack.
  void check_cracks() const;
  /// Of load steps with cracks: a step that has not come to its end after so many equilibria has none. 1000 unless
  /// told.
  void limit_equilibria(int most) { most_equilibria_ = most; }
  /// Raises the damage of cells, failure::Cracking::damage_cells(). Throws InputError also where no material can crack,
  /// and for a normal of zero.
  void damage_cells(const lattice::Field<double>& wanted, const Vec3& normal);

  const model::Model& model() const { return *model_; }
  /// The state, at rest until something changes it; takes its memory when first asked for.
  model::State& state();
  /// Of the state as it is now.
  mechanics::Meter& meter();
  /// What the ranks held before the model was made.
  const ResidentMemory& memory_before() const { return memory_before_; }

 private:
  mechanics::Measurement measure_at(double dt);
  Outcome run_static(const Observer& observer, const std::vector<std::string>& petsc_options);
  Outcome run_events(const Observer& observer, const std::vector<std::string>& petsc_options);
  Outcome run_load_steps(const Observer& observer, const std::vector<std::string>& petsc_options);
  double work_of_supports();
  // What both of these begin with, and measure.
  failure::Fracturing& restored_cracks();
  statics::StaticOptions crack_options(const Observer& observer, const std::vector<std::string>& petsc_options) const;
  mechanics::Measurement measure_cracked(const failure::CrackContact& contact);
  Outcome run_modes(const Observer& observer);
  Outcome run_explicit(const Observer& observer);
  double choose_step(const mechanics::StableStep& stable) const;
  /// Cracks of the state as it is now; none where nothing can crack.
  failure::Fracturing* fracturing();
  void check_support() const;
  void check_divergence(const mechanics::Balance& balance, const Observer& observer) const;

  ResidentMemory memory_before_;
  // On the heap, since parts refer to each other. Of the model only factors of loads, boundaries and cells
  // ever change.
  std::unique_ptr<model::Model> model_;
  std::unique_ptr<mechanics::ForceKernel> kernel_;
  std::unique_ptr<mechanics::Meter> meter_;
  std::optional<std::vector<std::string>> warnings_;  ///< set once prepared
  std::unique_ptr<model::State> state_;
  std::unique_ptr<failure::Fracturing> fracturing_;
  std::optional<mechanics::StableStep> stable_;        // once an explicit step was asked for
  std::unique_ptr<dynamics::ExplicitSolver> stepper_;  // of `step`; none during and after a run
  int most_equilibria_ = 1000;  // some tens in steps where many cells crack; hundreds where the force falls too fast
  double lag_ = 0;              // step whose middle the state's velocities belong to [s]
};

}  // namespace koshi::driver
