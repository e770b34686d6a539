#include "driver/results.h"

#include <fmt/format.h>

#include "base/escape.h"
#include "driver/mode_tables.h"
#include "mechanics/uniform_strain.h"

namespace koshi::driver {
namespace {

using Json = nlohmann::ordered_json;
using Type = model::AnalysisDefinition::Type;

constexpr std::array<const char*, 3> families{"edge", "face", "body"};
const std::vector<std::string> tensor = mechanics::component_names(model::ProbeDefinition::Quantity::strain);
constexpr std::array<const char*, 4> types{"static", "quasi-static", "dynamic", "modes"};

Json springs(const model::Model& model) {
  Json all = Json::object();
  for (std::size_t m = 1; m < model.lattice.springs.size(); ++m) {
    const material::Springs& s = model.lattice.springs[m];
    Json entry;
    for (std::size_t f = 0; f < families.size(); ++f) entry[families[f]] = {{"kn", s.kn[f]}, {"kt", s.kt[f]}};
    entry["kappa"] = s.kappa;
    all[model.definition.materials[m - 1].name] = entry;
  }
  return all;
}

Json analysis(const model::Model& model, const model::State& state, const Outcome& outcome) {
  Json entry{{"type", types[static_cast<std::size_t>(model.definition.analysis.type)]}};
  if (outcome.solution) {
    const statics::SolveReport& s = *outcome.solution;
    entry.update({{"unknowns", s.unknowns},
                  {"iterations", s.iterations},
                  {"levels", s.levels},
                  {"residual", s.relative_residual},
                  {"converged", s.converged},
                  {"reason", s.reason},
                  {"projected_motions", s.projected_motions},
                  {"residual_history", s.residual_history}});
    if (!s.free_motions.empty()) entry["free_motions"] = s.free_motions;
    if (outcome.path) {
      entry["reason"] = outcome.path->reason;
      const CrackPath& path = *outcome.path;
      if (model.definition.follows_events())
        entry.update(
            {{"events", path.events}, {"peak", {{"event", path.peak_event}, {"load_factor", path.peak_load_factor}}}});
      else
        entry.update({{"steps", path.steps}, {"equilibria", path.equilibria}, {"time", state.time}});
      entry.update({{"cracked_cells", path.cracked}, {"parted_cells", path.parted}, {"hierarchies", path.hierarchies}});
      if (!outcome.stop_reason.empty()) entry["stop_reason"] = outcome.stop_reason;
    }
    return entry;
  }
  if (outcome.modes) {
    entry.update(modes_analysis(*outcome.modes));
    return entry;
  }
  entry.update({{"steps", outcome.steps},
                {"time", state.time},
                {"time_step", outcome.time_step},
                {"stable_step", {{"wave", outcome.stable->wave}, {"frequency", outcome.stable->frequency}}},
                {"residual", outcome.measurement.balance.unbalanced_ratio()},
                {"converged", outcome.converged}});
  if (!outcome.stop_reason.empty()) entry["stop_reason"] = outcome.stop_reason;
  return entry;
}

// Null for strains across directions without a period, which have no mean.
Json macroscopic(const model::Model& model, const Outcome& outcome) {
  Json strain = Json::object(), stress = Json::object();
  const mechanics::MeanState& mean = *outcome.measurement.mean;
  for (std::size_t c = 0; c < 6; ++c) {
    strain[tensor[c]] = mechanics::has_mean_strain(model, c) ? Json(mean.strain[c]) : Json();
    stress[tensor[c]] = mean.stress[c];
  }
  Json entry{{"strain", strain}, {"stress", stress}};
  if (outcome.solution) entry["solves"] = outcome.solution->macroscopic->solves;
  return entry;
}

Json performance(const model::Model& model, const Outcome& outcome, const RunMemory& memory) {
  Json entry{{"seconds", outcome.seconds},
             {"ranks", model.communicator.size()},
             {"peak_memory", memory.peak},
             {"memory_before", memory.before.all},
             {"library_growth", memory.at_end.shared - memory.before.shared}};
  if (outcome.solution) {
    entry["setup_seconds"] = outcome.solution->setup_seconds;
    entry["solve_seconds"] = outcome.solution->solve_seconds;
    entry["unknowns_per_second"] = static_cast<double>(outcome.solution->unknowns) / outcome.seconds;
  } else if (outcome.modes) {
    entry["setup_seconds"] = outcome.modes->setup_seconds;
    entry["solve_seconds"] = outcome.modes->solve_seconds;
  } else {
    entry["node_steps_per_second"] =
        static_cast<double>(model.node_count) * static_cast<double>(outcome.steps) / outcome.seconds;
  }
  return entry;
}

}  // namespace

std::vector<std::string> history_columns(const model::Model& model) {
  std::vector<std::string> columns{"time [s]"};
  if (model.definition.follows_events()) columns = {"event [1]", "load factor [1]"};
  for (const model::Probe& probe : model.probes) {
    const auto quantity = probe.definition.quantity;
    for (const std::string& component : mechanics::component_names(quantity))
      columns.push_back(fmt::format("{}.{}.{} [{}]", probe.definition.name, mechanics::name_of(quantity), component,
                                    mechanics::unit_of(quantity)));
  }
  if (model.definition.macroscopic) {
    for (std::size_t c = 0; c < 6; ++c)
      if (mechanics::has_mean_strain(model, c)) columns.push_back(fmt::format("mean strain.{} [1]", tensor[c]));
    for (const std::string& component : tensor) columns.push_back(fmt::format("mean stress.{} [Pa]", component));
  }
  for (const char* energy :
       {"elastic energy [J]", "kinetic energy [J]", "leapfrog energy [J]", "unbalanced-force ratio [1]"})
    columns.emplace_back(energy);
  if (model.definition.cracks())
    for (const char* energy : {"work of loads and supports [J]", "damping [J]", "cracks [J]"})
      columns.emplace_back(energy);
  return columns;
}

std::vector<double> history_row(const model::Model& model, double time, const mechanics::Measurement& measurement) {
  std::vector<double> row{time};
  if (model.definition.follows_events()) row.push_back(measurement.balance.load_factor);
  for (const mechanics::ProbeValue& value : measurement.probes) row.insert(row.end(), value.begin(), value.end());
  if (measurement.mean) {
    for (std::size_t c = 0; c < 6; ++c)
      if (mechanics::has_mean_strain(model, c)) row.push_back(measurement.mean->strain[c]);
    row.insert(row.end(), measurement.mean->stress.begin(), measurement.mean->stress.end());
  }
  const mechanics::Balance& balance = measurement.balance;
  row.insert(row.end(),
             {balance.elastic_energy, balance.kinetic_energy, balance.leapfrog_energy, balance.unbalanced_ratio()});
  if (model.definition.cracks()) row.insert(row.end(), {balance.given, balance.damped, balance.cracked});
  return row;
}

nlohmann::ordered_json summary(const model::Model& model, const model::State& state, const Outcome& outcome,
                               const RunMemory& memory) {
  const mechanics::Measurement& end = outcome.measurement;
  Json probes = Json::object();
  for (std::size_t p = 0; p < end.probes.size(); ++p) {
    const model::ProbeDefinition& probe = model.probes[p].definition;
    probes[probe.name][mechanics::name_of(probe.quantity)] = end.probes[p];
  }
  Json all{{"title", model.definition.title},
           {"version", KOSHI_VERSION},
           {"body",
            {{"cells", model.lattice.grid.cells},
             {"solid_cells", model.cell_count},
             {"nodes", model.node_count},
             {"volume", model.volume()}}},
           {"springs", springs(model)},
           {"analysis", analysis(model, state, outcome)},
           {"probes", probes},
           {"energy", {{"elastic", end.balance.elastic_energy}, {"kinetic", end.balance.kinetic_energy}}},
           {"performance", performance(model, outcome, memory)}};
  if (outcome.measurement.mean) all["macroscopic"] = macroscopic(model, outcome);
  if (outcome.modes) {
    // A mode has no size, hence neither energy nor values at probes.
    all.erase("probes");
    all.erase("energy");
    all["modes"] = modes_summary(*outcome.modes);
  }
  return all;
}

namespace {

std::string macroscopic_text(const mechanics::MeanState& mean) {
  std::string strain = "  mean strain:", stress = "  mean stress:";
  for (std::size_t c = 0; c < 6; ++c) {
    strain += fmt::format("{} {} = {:.6g}", c == 0 ? "" : ",", tensor[c], mean.strain[c] + 0.0);
    stress += fmt::format("{} {} = {:.6g}", c == 0 ? "" : ",", tensor[c], mean.stress[c] + 0.0);
  }
  return strain + "\n" + stress + " Pa\n";
}

}  // namespace

std::string headline(const model::Model& model, const Outcome& outcome) {
  std::string text;
  if (outcome.modes) return modes_text(*outcome.modes, outcome.seconds);
  if (outcome.path && !model.definition.follows_events()) {
    const CrackPath& path = *outcome.path;
    text = fmt::format(
        "equilibrium of {} unknowns, {} steps with {} solutions in {} iterations, {:.3g} s: {}\n"
        "  {} cells cracked, {} of them through\n",
        outcome.solution->unknowns, path.steps, path.equilibria, outcome.solution->iterations, outcome.seconds,
        escaped(path.reason), path.cracked, path.parted);
  } else if (outcome.path) {
    const CrackPath& path = *outcome.path;
    text = fmt::format(
        "equilibrium of {} unknowns, {} events in {} iterations, {:.3g} s: {}\n"
        "  the most is carried at event {}, load factor {:.6g}; {} cells cracked, {} of them through\n",
        outcome.solution->unknowns, path.events, outcome.solution->iterations, outcome.seconds, escaped(path.reason),
        path.peak_event, path.peak_load_factor, path.cracked, path.parted);
  } else if (outcome.solution) {
    text = fmt::format("equilibrium of {} unknowns in {} iterations, residual {:.1e}, {:.3g} s\n",
                       outcome.solution->unknowns, outcome.solution->iterations, outcome.solution->relative_residual,
                       outcome.seconds);
    if (!outcome.solution->free_motions.empty())
      text += fmt::format("  {}; the solution is without that motion\n", outcome.solution->free_motions);
  } else {
    text = fmt::format(
        "{} nodes, {} steps of {:.4g} s, unbalanced-force ratio {:.1e}, {:.3g} s ({:.3g} million node-steps/s)\n",
        model.node_count, outcome.steps, outcome.time_step, outcome.measurement.balance.unbalanced_ratio(),
        outcome.seconds,
        1e-6 * static_cast<double>(model.node_count) * static_cast<double>(outcome.steps) / outcome.seconds);
  }
  if (outcome.measurement.mean) text += macroscopic_text(*outcome.measurement.mean);
  if (!outcome.stop_reason.empty() && !outcome.path)
    text += fmt::format("  ended at t = {:.6g} s: {}\n", static_cast<double>(outcome.steps) * outcome.time_step,
                        escaped(outcome.stop_reason));
  for (std::size_t p = 0; p < model.probes.size(); ++p) {
    const model::ProbeDefinition& probe = model.probes[p].definition;
    text += fmt::format("  {} {}: ", escaped(probe.name), mechanics::name_of(probe.quantity));
    const auto names = mechanics::component_names(probe.quantity);
    for (std::size_t c = 0; c < names.size(); ++c)
      text += fmt::format("{}{} = {:.6g}", c == 0 ? "" : ", ", names[c], outcome.measurement.probes[p][c]);
    text += fmt::format(" {}\n", mechanics::unit_of(probe.quantity));
  }
  return text;
}

}  // namespace koshi::driver
