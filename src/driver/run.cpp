#include "koshi/run.h"

#include <fmt/format.h>

#include <cstdio>

#include "base/collective.h"
#include "base/escape.h"
#include "base/log.h"
#include "base/memory.h"
#include "base/out_of_memory.h"
#include "base/progress.h"
#include "driver/checkpoints.h"
#include "driver/crack_files.h"
#include "driver/fields.h"
#include "driver/mode_tables.h"
#include "driver/results.h"
#include "driver/run_simulation.h"
#include "driver/scatter_report.h"
#include "driver/surface_file.h"
#include "io/cell_image.h"
#include "io/field_writer.h"
#include "io/history_writer.h"
#include "io/output_directory.h"
#include "io/summary.h"
#include "koshi/input.h"
#include "report/report.h"

namespace koshi::driver {

Outcome run_simulation(Simulation& simulation, const RunOptions& options, const Observer& outer) {
  const model::Model& model = simulation.model();
  const model::Definition& definition = model.definition;
  const Communicator& communicator = model.communicator;
  // Everything that can be wrong with the input is found before the output directory is made; the search for the stable
  // step comes before the state takes its memory, since it needs as much.
  collectively(communicator, [&] {
    if (definition.output.report && communicator.is_root()) report::check_report_template();
  });
  const std::vector<std::string>& warnings = simulation.prepare();
  if (!options.quiet && communicator.is_root())
    for (const std::string& warning : warnings) log_warning(warning);
  // Before cracks change the factors.
  const std::vector<ScatterReport> scatter = scatter_reports(model);
  if (!options.quiet && communicator.is_root())
    for (const ScatterReport& report : scatter) log_information("scatter: " + escaped(text(report)));
  const bool modal = definition.analysis.type == model::AnalysisDefinition::Type::modes;
  if (modal && !options.restart.empty())
    throw InputError("a search for modes writes no checkpoints and cannot go on from one; run it without --restart");
  model::State& state = simulation.state();
  Checkpoints checkpoints(model, options.directory);
  std::optional<double> restart_time;
  if (!options.restart.empty()) {
    checkpoints.restore(options.restart, state);
    restart_time = state.time;
  } else if (!definition.analysis.start_from.empty()) {
    start_from(std::filesystem::path(definition.directory) / definition.analysis.start_from, model, state);
  }
  const io::OutputDirectory held(communicator, options.directory);
  io::write_resolved(communicator, options.directory,
                     io::resolved_toml(io::with_cells_in_file(communicator, definition, options.directory)));

  io::FieldWriter field_writer(model, options.directory, restart_time);
  std::optional<io::HistoryWriter> history;
  if (!modal) history.emplace(communicator, options.directory, history_columns(model), restart_time);
  Progress progress(options.quiet || !communicator.is_root(), definition.title.empty() ? "koshi" : definition.title);

  Observer observer;
  nlohmann::ordered_json cracks;
  std::vector<double> load_factors;  // of an equilibrium that follows its cracks, by number of the event
  observer.history = [&](const mechanics::Measurement& measurement, model::State& at) {
    if (definition.follows_events()) load_factors.push_back(measurement.balance.load_factor);
    history->write(history_row(model, at.time, measurement));
  };
  observer.fields = [&](model::State& at, double) {
    while_making("a sample of the fields", [&] {
      const FieldSet set(definition.output.fields, model, at, simulation.meter());
      field_writer.write(at.time, set.fields());
    });
    if (definition.output.surface) while_making("the surface", [&] { write_surface(model, at, options.directory); });
    if (definition.cracks()) cracks = write_crack_files(model, at, load_factors, options.directory);
  };
  observer.progress = [&](double fraction, const std::string& details) {
    progress.update(fraction, details);
    if (outer.progress) outer.progress(fraction, details);
  };
  // An equilibrium and modes are sought in one go, without checkpoints on the way.
  const bool at_once = !definition.analysis.stepped();
  observer.poll = [&](model::State& at) {
    return (at_once ? checkpoints.stop_requested() : checkpoints.poll(at)) || (outer.poll && outer.poll(at));
  };
  observer.breathe = outer.breathe;
  observer.diverged = [&](model::State& at) {
    return fmt::format("; the diverged state is kept in {}", checkpoints.write_diverged(at).string());
  };

  Outcome outcome;
  try {
    outcome = simulation.run(observer, options.petsc_options);
  } catch (const RunError& error) {
    throw RunError(error.what() + checkpoints.remedy());
  }
  progress.finish("");
  if (outcome.solution && communicator.is_root())
    for (const std::string& option : outcome.solution->unused_options)
      fmt::print(stderr, "warning: PETSc option {} was not used; check its name\n", option);
  if (outcome.stopped && outcome.solution && !outcome.path && checkpoints.stop_requested())
    throw RunError(
        fmt::format("stopped by a signal after {} iterations (relative residual {:.1e}); a static analysis keeps no "
                    "checkpoint: run "
                    "it again",
                    outcome.solution->iterations, outcome.solution->relative_residual));
  if (modal && outcome.stopped && checkpoints.stop_requested())
    throw RunError(
        fmt::format("stopped by a signal after {} iterations; nothing is kept of a search for modes, start it "
                    "again",
                    outcome.modes->iterations));
  if (outcome.stopped && !outcome.path && checkpoints.stop_requested())
    throw RunError(fmt::format("stopped by a signal at step {} (t = {:.6g} s); go on with --restart {}", state.step,
                               state.time, (options.directory / "checkpoint.h5").string()));
  // An equilibrium may be the start of another run; other runs keep their end when they keep checkpoints at all.
  const bool equilibrium = modal              ? false
                           : outcome.solution ? !outcome.stopped || outcome.path
                                              : definition.analysis.type != model::AnalysisDefinition::Type::dynamic;
  if (equilibrium || definition.output.checkpoint_every || definition.output.checkpoint_wall) checkpoints.write(state);
  if (modal) io::write_table(communicator, options.directory / "modes.csv", mode_columns(), mode_rows(*outcome.modes));
  const RunMemory memory{peak_memory(communicator), simulation.memory_before(), resident_memory(communicator)};
  nlohmann::ordered_json results = summary(model, state, outcome, memory);
  if (!scatter.empty()) results["scatter"] = json(scatter);
  if (!cracks.is_null()) results["cracks"] = cracks;
  io::write_summary(communicator, options.directory, results);
  collectively(communicator, [&] {
    if (definition.output.report && communicator.is_root()) report::write_report(options.directory);
  });
  // What cracked until then is written like any other end.
  if (outcome.path && outcome.stopped && checkpoints.stop_requested())
    throw RunError(fmt::format("stopped by a signal after {} {}; the results so far are in {}",
                               definition.follows_events() ? outcome.path->events : outcome.path->steps,
                               definition.follows_events() ? "events" : "steps", options.directory.string()));
  return outcome;
}

void require_rest(const model::Model& model, const Outcome& outcome, const std::string& remark) {
  if (outcome.path && !outcome.path->endless.empty()) throw RunError(outcome.path->endless + remark);
  if (outcome.converged || !outcome.stop_reason.empty()) return;
  throw RunError(fmt::format(
      "not at rest after {} steps: unbalanced-force ratio {:.2e}, tolerance {:.2e}; give more time "
      "(analysis.duration), more damping, or a larger tolerance{}",
      outcome.steps, outcome.measurement.balance.unbalanced_ratio(), model.definition.analysis.tolerance, remark));
}

void run(const model::Definition& definition, const RunOptions& options, const Communicator& communicator) {
  Simulation simulation(definition, communicator);
  const Outcome outcome = run_simulation(simulation, options);
  if (!options.quiet && communicator.is_root())
    fmt::print("{}results in {}\n", headline(simulation.model(), outcome), escaped(options.directory.string()));
  require_rest(simulation.model(), outcome, "; the results so far are in " + options.directory.string());
}

}  // namespace koshi::driver
