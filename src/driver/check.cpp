#include <fmt/format.h>

#include <chrono>

#include "base/escape.h"
#include "base/memory.h"
#include "calibration/calibrate.h"
#include "driver/scatter_report.h"
#include "driver/schedule.h"
#include "driver/simulation.h"
#include "driver/warnings.h"
#include "failure/bond_limits.h"
#include "koshi/input.h"
#include "koshi/modes.h"
#include "koshi/run.h"
#include "mechanics/stable_step.h"

namespace koshi::driver {
namespace {

// Seconds of one force pass over the body, the least of three.
double seconds_per_pass(const model::Model& model, mechanics::ForceKernel& kernel) {
  lattice::Field<double> u(model.layout(), model.components()), force(model.layout(), model.components());
  double least = std::numeric_limits<double>::infinity();
  for (int repeat = 0; repeat < 3; ++repeat) {
    const auto start = std::chrono::steady_clock::now();
    kernel.apply(u, force);
    least = std::min(least, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return least;
}

std::string duration(double seconds) {
  if (seconds < 120) return fmt::format("{:.2g} s", seconds);
  if (seconds < 7200) return fmt::format("{:.2g} min", seconds / 60);
  return fmt::format("{:.2g} h", seconds / 3600);
}

std::string explicit_part(const model::Model& model) {
  mechanics::ForceKernel kernel(model.lattice);
  const mechanics::StableStep stable = mechanics::stable_step(model, kernel);
  const model::AnalysisDefinition& analysis = model.definition.analysis;
  const double dt = analysis.time_step.value_or(analysis.safety * stable.limit());
  check_step_count(model.definition, dt);
  std::string text =
      fmt::format("time step     {:.4g} s of at most {:.4g} s (d/c_p = {:.4g} s, 2/omega_max = {:.4g} s)\n", dt,
                  stable.limit(), stable.wave, stable.frequency);
  if (!analysis.duration) return text;
  const double steps = *analysis.duration / dt;
  return text + fmt::format("steps         {:.4g}, about {}\n", steps,
                            duration(1.5 * steps * seconds_per_pass(model, kernel)));
}

// When bonds break, and the tension of an even strain at which the first of them do so along an axis.
std::string bonds_part(const model::Model& model) {
  std::string text;
  for (std::size_t m = 1; m < model.lattice.springs.size(); ++m) {
    const model::MaterialDefinition& material = model.definition.materials[m - 1];
    if (!material.cracks()) continue;
    const failure::BondLimits limits = failure::bond_limits(*material.fracture, model.lattice.springs[m]);
    text += fmt::format("bonds         of \"{}\" break at a stretch of {:.4g}", escaped(material.name), limits.stretch);
    if (material.fracture->critical_shear) text += fmt::format(" or a shear of {:.4g}", limits.shear);
    text += fmt::format(", the first along an axis at a tension of {:.3g} Pa with this spacing\n",
                        limits.stretch * material.elastic.youngs_modulus);
  }
  return text;
}

// Cells whose material the coarsened image made of two.
std::int64_t mixed_cells(const model::Model& model) {
  std::vector<bool> mixed(model.materials.size());
  for (const model::Mixture& mixture : model.definition.body.mixtures) mixed[mixture.material] = true;
  std::int64_t count = 0;
  lattice::for_each_owned(model.layout(),
                          [&](auto, auto, auto, auto n) { count += mixed[model.lattice.cell.component(0)[n]]; });
  return model.communicator.sum(count);
}

std::string modes_part(const model::Model& model) {
  const model::AnalysisDefinition& analysis = model.definition.analysis;
  const std::string free = modes::free_motions(model, analysis);
  const std::string which = analysis.near == 0 ? "the lowest" : fmt::format("closest to {:.6g} Hz", analysis.near);
  return fmt::format("modes         {}, {}\nrigid motions {}\n", analysis.count, which,
                     free.empty() ? "none" : free + "; they are left out");
}

}  // namespace

std::string check(const model::Definition& definition, const Communicator& communicator) {
  const double libraries = resident_memory(communicator).all;
  const model::Model model = load_model(definition, communicator);
  const std::vector<std::string> found = warnings(model);
  std::string text = "# resolved input\n" + io::resolved_toml(definition) + "\n# what it means\n";
  const Int3& cells = model.lattice.grid.cells;
  text += fmt::format("cells         {} x {} x {}, {} solid\nnodes         {}, {} unknowns\n", cells[0], cells[1],
                      cells[2], model.cell_count, model.node_count, model.node_count * model.components());
  if (model.cut) {
    const double cell = model.volume() / model.cut->volume;
    text += fmt::format("volume        {:.9g} m^3, {} cells are cut; slivers of {:.3g} m^3 are left out\n",
                        model.volume(), model.cut->count, model.cut->left_out * cell);
  }
  if (const auto& mixtures = model.definition.body.mixtures; !mixtures.empty())
    text += fmt::format("mixtures      {} materials for {} cells that hold two solids\n", mixtures.size(),
                        mixed_cells(model));
  const double body = model::predicted_memory(model.definition, communicator.size());
  text += fmt::format("prescribed    {} components\nmemory        {:.3g} GB, of it {:.3g} GB for the body\n",
                      model.motion_count, (libraries + body) / 1e9, body / 1e9);
  if (definition.analysis.stepped()) text += explicit_part(model);
  if (definition.analysis.type == model::AnalysisDefinition::Type::modes) text += modes_part(model);
  if (definition.breaks_bonds()) text += bonds_part(model);
  for (const ScatterReport& report : scatter_reports(model))
    text += "scatter       " + escaped(driver::text(report)) + "\n";
  for (const std::string& warning : found) text += "warning       " + escaped(warning) + "\n";
  for (std::size_t m = 1; m <= definition.materials.size(); ++m)
    text += fmt::format("\n# material {}\n", escaped(definition.materials[m - 1].name)) +
            calibration::calibration_report(
                calibration::examine(definition.lattice, model.materials[m], model.lattice.springs[m]));
  return text;
}

}  // namespace koshi::driver
