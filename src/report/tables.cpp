#include "report/tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "calibration/calibrate.h"
#include "calibration/words.h"
#include "mechanics/measure.h"
#include "model/choices.h"
#include "report/conditions.h"

namespace koshi::report {
namespace {

using json = nlohmann::ordered_json;
using Quantity = model::ProbeDefinition::Quantity;

json column(const std::string& name) { return {{"name", name}}; }
json column(const std::string& name, const std::string& unit) { return {{"name", name}, {"unit", unit}}; }

json table(std::initializer_list<json> columns) { return {{"columns", columns}, {"rows", json::array()}}; }

calibration::Calibrated calibrated(const model::Definition& definition, const material::Elastic& elastic) {
  std::optional<Vec3> size;
  if (definition.lattice.springs == material::Sharing::plain && definition.body.size != Vec3{})
    size = definition.body.size;
  return calibration::calibrate(definition.lattice, elastic, size);
}

// Largest relative deviation of what was achieved from what was asked for.
double deviation(std::initializer_list<double> achieved, double asked) {
  double largest = 0;
  for (const double value : achieved)
    largest = std::max(largest, std::abs(value - asked) / (asked != 0 ? std::abs(asked) : 1));
  return largest;
}

// Springs as the run had them; those of the calibration where the summary is missing.
material::Springs springs_of(const json& summary, const std::string& material, const material::Springs& calibrated) {
  const json part = summary.value(json::json_pointer("/springs") / material, json());
  if (!part.is_object()) return calibrated;
  material::Springs springs;
  for (std::size_t family = 0; family < calibration::family_names.size(); ++family) {
    const json& bond = part.at(std::string(calibration::family_names[family]));
    springs.kn[family] = bond.at("kn");
    springs.kt[family] = bond.at("kt");
  }
  springs.kappa = part.at("kappa");
  return springs;
}

void append_springs(json& rows, const std::string& material, lattice::CellType cell, const material::Springs& springs) {
  constexpr std::array<const char*, lattice::family_count> bonds{"edges", "face diagonals", "body diagonals"};
  for (std::size_t family = 0; family < static_cast<std::size_t>(lattice::families_of(cell)); ++family)
    rows.push_back({material, bonds[family], springs.kn[family], springs.kt[family],
                    family == 0 ? json(springs.kappa) : json("")});
}

void append_achieved(json& rows, const std::string& material, const calibration::Calibrated& found) {
  if (!found.constants) return;
  const double E = found.elastic.youngs_modulus, nu = found.elastic.poissons_ratio;
  const Vec3& E_axis = found.constants->youngs_modulus;
  const auto& nu_axis = found.constants->poissons_ratio;
  rows.push_back({material, E, E_axis[0], E_axis[1], E_axis[2], deviation({E_axis[0], E_axis[1], E_axis[2]}, E), nu,
                  nu_axis[0][1], nu_axis[1][2], nu_axis[2][0],
                  deviation({nu_axis[0][1], nu_axis[1][2], nu_axis[2][0]}, nu), found.constants->zener_ratio});
}

std::string probe_place(const model::ProbeDefinition& probe) {
  const std::string nodes = place_text(probe.selection);
  return probe.reduce && !probe.selection.point ? fmt::format("{}, {}", nodes, model::choice_name(*probe.reduce))
                                                : nodes;
}

// SI unit of a number of the summary, which goes by its key.
std::string unit_of_key(const std::string& key) {
  if (key.ends_with("seconds") || key == "time" || key == "time_step") return "s";
  if (key.ends_with("memory") || key == "memory_before" || key == "library_growth") return "B";
  return "1";
}

// What the page calls a key of the summary.
std::string label_of_key(const std::string& key) {
  static const std::map<std::string, std::string> labels{{"seconds", "wall time"},
                                                         {"setup_seconds", "setup"},
                                                         {"solve_seconds", "solve"},
                                                         {"levels", "multigrid levels"},
                                                         {"time", "simulated time"},
                                                         {"reason", "ended by"},
                                                         {"projected_motions", "rigid motions taken out"}};
  if (const auto label = labels.find(key); label != labels.end()) return label->second;
  std::string words = key;
  std::ranges::replace(words, '_', ' ');
  return words;
}

// The numbers, words and yes-or-no of one part of the summary; null when there are none.
json part_table(const std::string& title, const json& part, const std::string& unit = {}) {
  json block = table({column("quantity"), column("value")});
  block["title"] = title;
  if (part.is_object())
    for (const auto& [key, value] : part.items()) {
      // Motion has no rest to come to; what stepping leaves over is forces, not an equation's residual.
      if (key == "converged" && part.value("type", "") == "dynamic") continue;
      const std::string label =
          key == "residual" && part.contains("steps") ? "unbalanced-force ratio" : label_of_key(key);
      if (value.is_number())
        block["rows"].push_back({label, json{{"value", value}, {"unit", unit.empty() ? unit_of_key(key) : unit}}});
      else if (value.is_boolean())
        block["rows"].push_back({label, value.get<bool>() ? "yes" : "no"});
      else if (value.is_string())
        block["rows"].push_back({label, value.get<std::string>()});
    }
  return block["rows"].empty() ? json() : block;
}

}  // namespace

std::string report_subtitle(const model::Definition& definition) {
  const model::LatticeDefinition& lattice = definition.lattice;
  std::string cell(lattice::name(lattice.cell));
  cell[0] = static_cast<char>(std::toupper(cell[0]));
  return fmt::format("{}, {} springs, {} calibration, {} kinematics; {} analysis", cell,
                     model::choice_name(lattice.springs), model::choice_name(definition.calibration()),
                     model::choice_name(lattice.kinematics), model::choice_name(definition.analysis.type));
}

nlohmann::ordered_json materials_table(const model::Definition& definition) {
  json block = table({column("material"), column("E", "Pa"), column("ν"), column("density", "kg/m^3")});
  for (const auto& [name, elastic, fracture, scatter] : definition.materials)
    block["rows"].push_back({name, elastic.youngs_modulus, elastic.poissons_ratio, elastic.density});
  return block;
}

SpringTables spring_tables(const model::Definition& definition, const nlohmann::ordered_json& summary) {
  SpringTables tables{
      table({column("material"), column("bonds"), column("k_n", "N/m"), column("k_t", "N/m"), column("κ", "Pa")}),
      table({column("material"), column("E asked", "Pa"), column("E_x", "Pa"), column("E_y", "Pa"), column("E_z", "Pa"),
             column("deviation"), column("ν asked"), column("ν_xy"), column("ν_yz"), column("ν_zx"),
             column("deviation"), column("Zener ratio")})};
  for (const auto& [name, elastic, fracture, scatter] : definition.materials) {
    const calibration::Calibrated found = calibrated(definition, elastic);
    append_springs(tables.springs["rows"], name, definition.lattice.cell, springs_of(summary, name, found.springs));
    append_achieved(tables.achieved["rows"], name, found);
  }
  const bool body = definition.lattice.springs == material::Sharing::plain;
  tables.achieved["note"] =
      body ? "Of the whole body: plain springs are stiffer at its surface." : "Of the lattice inside the bulk.";
  return tables;
}

nlohmann::ordered_json probe_tables(const model::Definition& definition, const nlohmann::ordered_json& summary) {
  json tables = json::array();
  for (const Quantity quantity : {Quantity::displacement, Quantity::rotation, Quantity::velocity, Quantity::reaction,
                                  Quantity::moment, Quantity::stress, Quantity::strain}) {
    const std::string name = mechanics::name_of(quantity), unit = mechanics::unit_of(quantity);
    json block = table({column("probe"), column("where")});
    const auto components = mechanics::component_names(quantity);
    for (const std::string& component : components) block["columns"].push_back(column(component, unit));
    for (const model::ProbeDefinition& probe : definition.probes) {
      if (probe.quantity != quantity) continue;
      const json value = summary.value(json::json_pointer("/probes") / probe.name / name, json::array());
      if (value.size() != components.size()) continue;
      json row{probe.name, probe_place(probe)};
      row.insert(row.end(), value.begin(), value.end());
      block["rows"].push_back(row);
    }
    if (block["rows"].empty()) continue;
    block["title"] = fmt::format("{}{}", static_cast<char>(std::toupper(name[0])), name.substr(1));
    tables.push_back(block);
  }
  return tables;
}

nlohmann::ordered_json run_tables(const nlohmann::ordered_json& summary) {
  json tables = json::array();
  for (json block : {part_table("Analysis", summary.value("analysis", json())),
                     part_table("Energy", summary.value("energy", json()), "J"),
                     part_table("Performance", summary.value("performance", json()))})
    if (!block.is_null()) tables.push_back(std::move(block));
  return tables;
}

}  // namespace koshi::report
