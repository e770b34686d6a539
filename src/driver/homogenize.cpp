#include "koshi/homogenize.h"

#include <fmt/format.h>

#include <cstdio>
#include <optional>

#include "base/collective.h"
#include "base/escape.h"
#include "base/out_of_memory.h"
#include "driver/simulation.h"
#include "driver/stiffness_studies.h"
#include "driver/stiffness_tables.h"
#include "io/cell_image.h"
#include "io/files.h"
#include "io/output_directory.h"
#include "io/summary.h"
#include "koshi/input.h"
#include "koshi/run.h"
#include "report/report.h"

namespace koshi::driver {

void homogenize(const model::Definition& asked, const RunOptions& options, const HomogenizeOptions& how,
                const Communicator& communicator) {
  using koshi::homogenize::Boundary;

  // What the case says by itself comes before its files are read.
  koshi::homogenize::require_loadable_cell(asked, how.boundary);
  model::Definition definition = asked;
  if (how.boundary != Boundary::periodic) definition.body.periodic = {};
  if (definition.output.report) collectively(communicator, [] { report::check_report_template(); });
  const model::Model model = load_model(definition, communicator);
  std::optional<model::Definition> coarse;
  if (how.coarser) coarse = coarser(model);
  const io::OutputDirectory held(communicator, options.directory);
  io::write_resolved(communicator, options.directory,
                     io::resolved_toml(io::with_cells_in_file(communicator, definition, options.directory)));

  statics::StaticOptions solve;
  solve.tolerance = definition.analysis.tolerance;
  solve.petsc_options = options.petsc_options;
  const koshi::homogenize::Effective effective = while_making("the fields of the six load cases", [&] {
    return koshi::homogenize::effective_stiffness(model, solve, how.boundary);
  });

  // Studies of the same body in other cells, and of parts of it.
  std::optional<koshi::homogenize::Effective> twice;
  if (coarse)
    twice = koshi::homogenize::effective_stiffness(model::make_model(*coarse, communicator), solve, how.boundary);
  coarse.reset();
  const std::vector<BoxSample> boxes =
      sample_boxes(model, how.boxes, how.boundary == Boundary::periodic ? Boundary::mixed : how.boundary, solve);

  nlohmann::ordered_json json = stiffness_json(model, effective);
  if (twice) json["coarser"] = coarser_json(effective, *twice);
  collectively(communicator, [&] {
    constexpr auto replace = nlohmann::ordered_json::error_handler_t::replace;
    if (communicator.is_root())
      io::replace_file(options.directory / "stiffness.json", escaped(json.dump(2, ' ', false, replace), true) + "\n");
  });
  io::write_table(communicator, options.directory / "stiffness.csv", stiffness_columns(), stiffness_rows(effective));
  io::write_table(communicator, options.directory / "directions.csv", direction_columns(), direction_rows(effective));
  if (how.boxes > 0) io::write_table(communicator, options.directory / "boxes.csv", box_columns(), box_rows(boxes));
  if (definition.output.report)
    collectively(communicator, [&] {
      if (communicator.is_root()) report::write_report(options.directory);
    });
  if (!options.quiet && communicator.is_root())
    fmt::print("{}{}{}results in {}\n", stiffness_text(model, effective), twice ? coarser_text(effective, *twice) : "",
               boxes_text(boxes), escaped(options.directory.string()));
}

}  // namespace koshi::driver
