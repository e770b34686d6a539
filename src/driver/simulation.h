// One analysis from its definition to its end, without files: the schedule of samples, checks and stops.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "koshi/model.h"
#include "koshi/statics.h"
#include "mechanics/measure.h"
#include "mechanics/stable_step.h"

namespace koshi::driver {

/// How an analysis went.
struct Outcome {
  std::int64_t steps = 0;                        ///< explicit steps
  double time_step = 0;                          ///< [s]
  std::optional<mechanics::StableStep> stable;   ///< explicit analyses
  std::optional<statics::SolveReport> solution;  ///< static analyses
  bool converged = true;                         ///< quasi-static: the tolerance was reached
  bool stopped = false;                          ///< the observer asked to stop
  double seconds = 0;                            ///< wall time of stepping or solving
  mechanics::Measurement measurement;            ///< at the end
};

/// What happens on the way; each may be empty. All are called on all ranks.
struct Observer {
  /// A row of the history: at the start, at regular intervals and at the end.
  std::function<void(const mechanics::Measurement&, model::State&)> history;
  /// A sample of the fields: at multiples of output.every and at the end. `dt` as in Meter.
  std::function<void(model::State&, double dt)> fields;
  /// Part of the work done (negative: unknown) and a few words.
  std::function<void(double, const std::string&)> progress;
  /// Called every few steps; true stops the run.
  std::function<bool(model::State&)> poll;
};

/// The model of a definition, files that it names read first (collective).
model::Model load_model(const model::Definition& definition, const Communicator& communicator);

/// A model with its state, ready to run.
class Simulation {
 public:
  Simulation(const model::Definition& definition, const Communicator& communicator);

  /// Finds what only the built model shows to be wrong (collective): throws InputError for a time step that is not
  /// stable or a quasi-static body without support. `run` does it too; before files are made is the time for it.
  void prepare();

  /// Runs the analysis of the definition from the present state to its end. Throws InputError as `prepare`, RunError
  /// when the run diverges or does not converge.
  Outcome run(const Observer& observer, const std::vector<std::string>& petsc_options = {});

  const model::Model& model() const { return *model_; }
  model::State& state() { return *state_; }
  mechanics::Meter& meter() { return *meter_; }

 private:
  Outcome run_static(const Observer& observer, const std::vector<std::string>& petsc_options);
  Outcome run_explicit(const Observer& observer);
  double choose_step(const mechanics::StableStep& stable) const;
  void check_support() const;
  void check_divergence(const mechanics::Balance& balance) const;

  // On the heap, since parts refer to each other.
  std::unique_ptr<const model::Model> model_;
  std::unique_ptr<mechanics::ForceKernel<double>> kernel_;
  std::unique_ptr<mechanics::Meter> meter_;
  std::unique_ptr<model::State> state_;
  std::optional<mechanics::StableStep> stable_;  ///< explicit analyses, once prepared
};

}  // namespace koshi::driver
