#include "koshi/run.h"

#include <fmt/format.h>

#include <cstdio>

#include "base/collective.h"
#include "base/memory.h"
#include "base/progress.h"
#include "driver/fields.h"
#include "driver/report.h"
#include "driver/results.h"
#include "driver/run_simulation.h"
#include "io/cell_image.h"
#include "io/field_writer.h"
#include "io/history_writer.h"
#include "io/output_directory.h"
#include "io/summary.h"
#include "koshi/input.h"

namespace koshi::driver {

Outcome run_simulation(Simulation& simulation, const RunOptions& options, const Observer& outer) {
  const model::Model& model = simulation.model();
  const model::Definition& definition = model.definition;
  const Communicator& communicator = model.communicator;
  simulation.prepare();
  io::make_output_directory(communicator, options.directory);
  io::write_resolved(communicator, options.directory,
                     io::resolved_toml(io::with_cells_in_file(communicator, definition, options.directory)));

  io::FieldWriter field_writer(model, options.directory, std::nullopt);
  io::HistoryWriter history(communicator, options.directory, history_columns(model), std::nullopt);
  Progress progress(options.quiet || !communicator.is_root(), definition.title.empty() ? "koshi" : definition.title);

  Observer observer;
  observer.history = [&](const mechanics::Measurement& measurement, model::State& state) {
    history.write(history_row(state.time, measurement));
  };
  observer.fields = [&](model::State& state, double) {
    const FieldSet set(definition.output.fields, model, state, simulation.meter());
    field_writer.write(state.time, set.fields());
  };
  observer.progress = [&](double fraction, const std::string& details) {
    progress.update(fraction, details);
    if (outer.progress) outer.progress(fraction, details);
  };
  observer.poll = outer.poll;

  Outcome outcome = simulation.run(observer, options.petsc_options);
  io::write_summary(communicator, options.directory,
                    summary(model, simulation.state(), outcome, peak_memory(communicator)));
  collectively(communicator, [&] {
    if (definition.output.report && communicator.is_root()) write_report(options.directory);
  });
  progress.finish("");
  return outcome;
}

void require_rest(const model::Model& model, const Outcome& outcome, const std::string& remark) {
  if (outcome.converged) return;
  throw RunError(fmt::format(
      "not at rest after {} steps: unbalanced-force ratio {:.2e}, tolerance {:.2e}; give more time "
      "(analysis.duration), more damping, or a larger tolerance{}",
      outcome.steps, outcome.measurement.balance.unbalanced_ratio(), model.definition.analysis.tolerance, remark));
}

void run(const model::Definition& definition, const RunOptions& options, const Communicator& communicator) {
  // Everything that can be wrong with the input is found before the output directory is made.
  Simulation simulation(definition, communicator);
  const Outcome outcome = run_simulation(simulation, options);
  if (!options.quiet && communicator.is_root())
    fmt::print("{}results in {}\n", headline(simulation.model(), outcome), options.directory.string());
  require_rest(simulation.model(), outcome, "; the results so far are in " + options.directory.string());
}

}  // namespace koshi::driver
