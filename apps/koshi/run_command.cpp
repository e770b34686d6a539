#include <CLI/CLI.hpp>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <iostream>
#include <map>
#include <memory>
#include <new>

#include "base/escape.h"
#include "commands.h"
#include "koshi/input.h"
#include "koshi/run.h"
#include "lattice/partition.h"
#include "launch.h"
#include "model/regions.h"

namespace koshi::app {
namespace {

struct Options {
  std::string file;
  std::vector<std::string> overrides;
  driver::RunOptions run;
  int ranks = 1;
};

// The case's own name beside it is clutter; results go to "CASE.out" where the program was started.
std::filesystem::path default_directory(const std::string& file) {
  return std::filesystem::path(file).stem().string() + ".out";
}

// Ends a run on several ranks, all of which threw the same error. One of them reports it, and the others wait for that:
// the launcher stops every rank as soon as one has left.
void leave_together(const Communicator& world, const std::string& message, int exit_code) {
  if (world.is_root()) std::cerr << message << std::endl;
  world.barrier();
  std::_Exit(exit_code);
}

// Refuses more processes than the nodes of the body can be shared among, before any is started.
void check_ranks(model::Definition definition, int ranks) {
  definition.regions.clear();
  // What may name a region or a selection.
  definition.selections.clear();
  definition.boundaries.clear();
  definition.loads.clear();
  definition.probes.clear();
  definition.analysis.stop_when.reset();  // it names a probe
  definition.analysis.steps.reset();      // they need histories
  try {
    lattice::make_partition(model::make_grid(io::load_files(definition)), ranks);
  } catch (const InputError& error) {
    throw error.place().file.empty() ? InputError(Place{"--ranks"}, error.message()) : error;
  }
}

// What a command does with a case, on all ranks.
using Work = std::function<void(const model::Definition&, const driver::RunOptions&, const Communicator&)>;

void run(const Options& options, const Arguments& arguments, const Work& work) {
  // Read first: wrong input is reported once, and without starting ranks.
  const model::Definition definition = io::read_case(options.file, options.overrides);
  if (options.ranks > 1 && !is_launched()) {
    check_ranks(definition, options.ranks);
    launch(options.ranks, arguments);
  }
  const Environment environment(nullptr, nullptr);
  const Communicator world = Communicator::world();
  try {
    driver::RunOptions run = options.run;
    if (run.directory.empty()) run.directory = default_directory(options.file);
    work(definition, run, world);
  } catch (const InputError& error) {
    if (world.size() > 1) leave_together(world, error.what(), 2);
    throw;
  } catch (const RunError& error) {
    if (world.size() > 1) leave_together(world, "error: " + escaped(error.what(), true), 1);
    throw;
  } catch (const std::bad_alloc& error) {
    // Memory may have run out on this rank alone: the launcher stops the others, which may wait for it.
    if (world.size() == 1) throw;
    std::cerr << "error: " << error.what() << std::endl;
    std::_Exit(1);
  }
}

// What all commands take that compute a case; only some can go on from a checkpoint.
std::shared_ptr<Options> add_options(CLI::App& command, const Arguments& petsc, bool restarts) {
  const auto options = std::make_shared<Options>();
  options->run.petsc_options = petsc;
  command.add_option("case", options->file, "Input file (TOML)")->required();
  command.add_option("--out", options->run.directory, "Output directory; unset: the case's name with .out");
  command.add_option("--set", options->overrides, "Override an input: section.key=value")->allow_extra_args(false);
  command.add_option("--ranks", options->ranks, "Number of processes")->check(CLI::Range(1, 1000000));
  if (restarts) command.add_option("--restart", options->run.restart, "Checkpoint to go on from");
  command.add_flag("--quiet", options->run.quiet, "Print errors only");
  return options;
}

}  // namespace

void add_run_command(CLI::App& app, const Arguments& arguments, const Arguments& petsc) {
  CLI::App* command = app.add_subcommand("run", "Compute a case; PETSc options may follow after --");
  const auto options = add_options(*command, petsc, true);
  command->callback([options, &arguments] { run(*options, arguments, driver::run); });
}

void add_homogenize_command(CLI::App& app, const Arguments& arguments, const Arguments& petsc) {
  CLI::App* command = app.add_subcommand(
      "homogenize", "Effective stiffness of a box of cells, periodic or not; PETSc options may follow after --");
  const auto options = add_options(*command, petsc, false);
  const auto how = std::make_shared<driver::HomogenizeOptions>();
  const std::map<std::string, homogenize::Boundary> words{{"periodic", homogenize::Boundary::periodic},
                                                          {"displacement", homogenize::Boundary::displacement},
                                                          {"traction", homogenize::Boundary::traction},
                                                          {"mixed", homogenize::Boundary::mixed}};
  command->add_option("--boundary", how->boundary, "periodic (default), displacement, traction or mixed")
      ->transform(CLI::CheckedTransformer(words))
      ->type_name("WORD");
  command->add_flag("--coarser", how->coarser, "Also with cells of twice the side, for the error of the cells");
  command->add_option("--boxes", how->boxes, "Random boxes of each size, for the scatter of smaller samples")
      ->check(CLI::Range(0, 10000));
  command->callback([options, how, &arguments] {
    run(*options, arguments, [how](const auto& definition, const auto& run_options, const Communicator& world) {
      driver::homogenize(definition, run_options, *how, world);
    });
  });
}

void add_check_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("check", "Validate a case and say what it means, without running it");
  const auto options = std::make_shared<Options>();
  command->add_option("case", options->file, "Input file (TOML)")->required();
  command->add_option("--set", options->overrides, "Override an input: section.key=value")->allow_extra_args(false);
  command->callback([options] {
    const model::Definition definition = io::read_case(options->file, options->overrides);
    const Environment environment(nullptr, nullptr);
    std::cout << driver::check(definition, Communicator::world());
  });
}

void add_schema_command(CLI::App& app) {
  app.add_subcommand("schema", "Print the JSON Schema of the input")->callback([] {
    std::cout << io::schema_json() << '\n';
  });
}

}  // namespace koshi::app
