#include "koshi/homogenize.h"

#include <fmt/format.h>

#include <cstdio>

#include "base/collective.h"
#include "base/escape.h"
#include "base/out_of_memory.h"
#include "driver/simulation.h"
#include "driver/stiffness_tables.h"
#include "io/cell_image.h"
#include "io/files.h"
#include "io/output_directory.h"
#include "io/summary.h"
#include "koshi/input.h"
#include "koshi/run.h"

namespace koshi::driver {

void homogenize(const model::Definition& definition, const RunOptions& options, const Communicator& communicator) {
  // What the case says by itself comes before its files are read.
  koshi::homogenize::require_periodic_cell(definition);
  const model::Model model = load_model(definition, communicator);
  const io::OutputDirectory held(communicator, options.directory);
  io::write_resolved(communicator, options.directory,
                     io::resolved_toml(io::with_cells_in_file(communicator, definition, options.directory)));

  statics::StaticOptions solve;
  solve.tolerance = definition.analysis.tolerance;
  solve.petsc_options = options.petsc_options;
  const koshi::homogenize::Effective effective = while_making(
      "the fields of the six load cases", [&] { return koshi::homogenize::effective_stiffness(model, solve); });

  collectively(communicator, [&] {
    constexpr auto replace = nlohmann::ordered_json::error_handler_t::replace;
    if (communicator.is_root())
      io::replace_file(options.directory / "stiffness.json",
                       escaped(stiffness_json(model, effective).dump(2, ' ', false, replace), true) + "\n");
  });
  io::write_table(communicator, options.directory / "stiffness.csv", stiffness_columns(), stiffness_rows(effective));
  if (!options.quiet && communicator.is_root())
    fmt::print("{}results in {}\n", stiffness_text(model, effective), escaped(options.directory.string()));
}

}  // namespace koshi::driver
