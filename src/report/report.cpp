#include "report/report.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <cstdlib>
#include <map>
#include <vector>

#include "base/escape.h"
#include "io/field_reader.h"
#include "io/files.h"
#include "io/history_reader.h"
#include "io/report_block.h"
#include "koshi/error.h"
#include "koshi/input.h"
#include "report/conditions.h"
#include "report/events.h"
#include "report/history.h"
#include "report/mesh.h"
#include "report/modes.h"
#include "report/stiffness.h"
#include "report/tables.h"

namespace koshi::report {
namespace {

namespace fs = std::filesystem;
using json = nlohmann::ordered_json;

json read_summary(const fs::path& path) {
  if (!fs::exists(path)) return json::object();
  json summary = json::parse(io::read_file(path), nullptr, false);
  if (!summary.is_object()) throw InputError(fmt::format("{} is no summary of a run", path.native()));
  return summary;
}

json fact(const char* label, json value, const char* unit = nullptr) {
  json block{{"label", label}, {"value", std::move(value)}};
  if (unit) block["unit"] = unit;
  return block;
}

json facts(const model::Definition& definition, const json& summary) {
  json list = json::array();
  if (definition.body.size != Vec3{}) list.push_back(fact("Body", definition.body.size, "m"));
  list.push_back(fact("Spacing", definition.lattice.spacing, "m"));
  const auto add = [&](const char* label, const char* pointer, const char* unit = nullptr) {
    const json value = summary.value(json::json_pointer(pointer), json());
    if (value.is_number()) list.push_back(fact(label, value, unit));
  };
  add("Cells", "/body/solid_cells");
  add("Nodes", "/body/nodes");
  add("Unknowns", "/analysis/unknowns");
  add("Steps", "/analysis/steps");
  add("Iterations", "/analysis/iterations");
  add("Computed in", "/performance/seconds", "s");
  return list;
}

// The file that holds this code: the program, or the Python module.
fs::path own_file() {
  Dl_info info{};
  if (::dladdr(reinterpret_cast<const void*>(&own_file), &info) == 0 || info.dli_fname == nullptr) return {};
  std::error_code unknown;
  const fs::path file = fs::canonical(info.dli_fname, unknown);
  return unknown ? fs::path() : file;
}

// Where the built page lies: said by the environment, in share/koshi of the build or installed tree that the program or
// module belongs to (prefix/bin/koshi, prefix/lib/python3/dist-packages/koshi/_koshi.so), or where this build is to be
// installed (for the library in other programs).
fs::path find_template() {
  std::vector<fs::path> places;
  if (const char* said = std::getenv("KOSHI_REPORT_TEMPLATE")) places.emplace_back(said);
  std::error_code unknown;
  for (const fs::path& file : {fs::path(fs::read_symlink("/proc/self/exe", unknown)), own_file()}) {
    fs::path folder = file.parent_path();
    for (int up = 0; up < 5 && folder.has_relative_path(); ++up, folder = folder.parent_path())
      places.push_back(folder / "share/koshi/report.html");
  }
  places.emplace_back(KOSHI_DATA_DIRECTORY "/report.html");
  for (const fs::path& place : places)
    if (fs::exists(place)) return place;
  throw RunError(fmt::format("the template of reports is not installed (it is built with npm); looked for {}",
                             places.back().native()));
}

// What the page takes from the summary; json::exception when a part of it has another form than Koshi gives it.
void add_summary(json& data, const model::Definition& definition, const json& summary) {
  data["facts"] = facts(definition, summary);
  const SpringTables springs = spring_tables(definition, summary);
  data["springs"] = springs.springs;
  data["achieved"] = springs.achieved;
  data["probes"] = probe_tables(definition, summary);
  data["timing"] = run_tables(summary);
  if (json modes = modes_table(summary); !modes.is_null()) data["tables"] = {std::move(modes)};
  const json residuals = summary.value(json::json_pointer("/analysis/residual_history"), json());
  if (residuals.is_array() && residuals.size() > 1)
    data["convergence"] = {{"residuals", residuals}, {"tolerance", definition.analysis.tolerance}};
}

// The body, with its true surface where regions cut its cells and their files are still there.
json body_block(model::Definition definition, std::span<const ReportSample> samples,
                std::span<const std::string> materials) {
  if (!definition.cuts()) return mesh_block(samples, materials);
  // Triangles are read of surfaces that have names.
  for (std::size_t r = 0; r < definition.regions.size(); ++r)
    if (definition.regions[r].name.empty()) definition.regions[r].name = fmt::format("region {} without a name", r + 1);
  std::string missing;
  try {
    definition = io::load_files(std::move(definition));
  } catch (const InputError& error) {
    missing = fmt::format("The surface is that of the cells, because {}.", error.message());
  }
  json mesh = mesh_block(samples, materials, missing.empty() ? &definition : nullptr);
  if (!missing.empty())
    mesh["note"] = mesh.contains("note") ? fmt::format("{} {}", missing, mesh["note"].get<std::string>()) : missing;
  return mesh;
}

// Names with characters that a page would not show, or would take for directions, are shown escaped.
json shown(json data) {
  if (data.is_string()) return escaped(data.get_ref<const std::string&>(), true);
  if (data.is_array())
    for (auto& element : data) element = shown(std::move(element));
  if (!data.is_object()) return data;
  json object = json::object();
  for (auto& [name, value] : data.items()) object[escaped(name, true)] = shown(std::move(value));
  return object;
}

}  // namespace

nlohmann::ordered_json report_data(const fs::path& directory) {
  const fs::path input = directory / "resolved.toml";
  if (!fs::exists(input))
    throw InputError(fmt::format("{} holds no results: resolved.toml is missing; give the --out directory of a run",
                                 directory.native()));
  const std::string case_text = io::read_file(input);
  const model::Definition definition = io::read_case(input);
  const json summary = read_summary(directory / "summary.json");
  const json stiffness = read_summary(directory / "stiffness.json");

  json data{{"format", "koshi-report/1"},
            {"version", KOSHI_VERSION},
            {"title", definition.title.empty() ? directory.filename().native() : definition.title},
            {"subtitle", report_subtitle(definition)},
            {"case", case_text},
            {"summary", summary},
            {"materials", materials_table(definition)},
            {"conditions", conditions_table(definition)}};
  const bool modal = definition.analysis.type == model::AnalysisDefinition::Type::modes;
  std::map<int, std::string> labels;  // of modes
  try {
    add_summary(data, definition, summary);
    if (modal) labels = mode_labels(summary);
  } catch (const json::exception&) {
    throw InputError(fmt::format("{} is no summary as Koshi writes it", (directory / "summary.json").native()));
  }

  try {
    if (!stiffness.empty()) add_stiffness(stiffness, data);
  } catch (const json::exception&) {
    throw InputError(fmt::format("{} is no stiffness as Koshi writes it", (directory / "stiffness.json").native()));
  }

  if (const fs::path history = directory / "history.csv"; fs::exists(history))
    data["history"] = history_block(io::read_history(history), definition);
  if (const fs::path events = directory / "events.csv"; fs::exists(events) && definition.cracks())
    data["curves"] =
        event_curves(io::read_history(events), summary.value(json::json_pointer("/cracks/events/b_value"), json()));
  std::vector<ReportSample> samples;
  for (const auto& [time, path] : io::list_samples(directory))
    samples.push_back({path, time, labels[static_cast<int>(time)]});
  std::vector<std::string> materials;
  for (const model::MaterialDefinition& material : definition.materials) materials.push_back(material.name);
  if (!samples.empty()) {
    data["mesh"] = body_block(definition, samples, materials);
    if (modal) data["mesh"]["swings"] = true;
  }
  return data;
}

void write_report_page(const fs::path& file, const nlohmann::ordered_json& data) {
  io::replace_file(file, io::filled_template(io::read_file(find_template()), shown(data)));
}

void check_report_template() { find_template(); }

void write_report(const fs::path& directory) { write_report_page(directory / "report.html", report_data(directory)); }

}  // namespace koshi::report
