#include "report/conditions.h"

#include <fmt/format.h>

#include "model/choices.h"

namespace koshi::report {
namespace {

using json = nlohmann::ordered_json;

json quantity(const json& value, const char* unit) { return {{"value", value}, {"unit", unit}}; }

json over_time(const model::History& history, double ramp) {
  if (!history.empty())
    return fmt::format("times a factor given at {} times, {:.6g} at the end", history.size(), history.back()[1]);
  return ramp > 0 ? fmt::format("rises from 0 within {:.6g} s", ramp) : "constant";
}

void append_boundary(json& rows, const model::BoundaryDefinition& boundary) {
  const std::string place = place_text(boundary.selection);
  std::vector<std::string_view> fixed;
  for (std::size_t c = 0; c < boundary.fix.size(); ++c)
    if (boundary.fix[c]) fixed.push_back(model::component_names[c]);
  if (!fixed.empty()) rows.push_back({boundary.name, place, fmt::format("{}", fmt::join(fixed, ", ")), "fixed", ""});

  if (boundary.support) rows.push_back({boundary.name, place, "support", model::choice_name(*boundary.support), ""});

  const auto moved = [&](const std::string& what, double value, const char* unit) {
    rows.push_back({boundary.name, place, what, quantity(value, unit), over_time(boundary.history, boundary.ramp)});
  };
  for (std::size_t c = 0; c < boundary.fix.size(); ++c) {
    const bool turns = c >= 3;
    const std::string component(model::component_names[c]);
    if (const auto& value = boundary.displacement[c])
      moved((turns ? "rotation " : "displacement ") + component, *value, turns ? "rad" : "m");
    if (const auto& value = boundary.velocity[c]) moved("velocity " + component, *value, turns ? "rad/s" : "m/s");
  }
  for (std::size_t a = 0; a < boundary.twist.size(); ++a)
    if (const auto& angle = boundary.twist[a])
      moved(fmt::format("turn about {}", model::component_names[a]), *angle, "rad");
}

void append_load(json& rows, const model::LoadDefinition& load) {
  const auto acts = [&](const char* what, const json& value, const char* unit) {
    rows.push_back({load.name, place_text(load.selection), what, quantity(value, unit), over_time(load.history, 0)});
  };
  if (load.force)
    acts(load.distribution == model::LoadDefinition::Distribution::area ? "force" : "force, the same on every node",
         *load.force, "N");
  if (load.traction) acts("traction", *load.traction, "Pa");
  if (load.pressure) acts("pressure", *load.pressure, "Pa");
  if (load.acceleration) acts("acceleration", *load.acceleration, "m/s^2");
}

}  // namespace

std::string place_text(const model::Selection& selection) {
  if (selection.face) return model::choice_name(*selection.face);
  if (selection.point) return fmt::format("point ({:.6g}) m", fmt::join(*selection.point, ", "));
  if (!selection.surface.empty()) return fmt::format("surface of \"{}\"", selection.surface);
  if (!selection.named.empty()) return fmt::format("selection \"{}\"", selection.named);
  if (!selection.box) return "whole body";
  return fmt::format("box ({:.6g}) to ({:.6g}) m", fmt::join(selection.box->first, ", "),
                     fmt::join(selection.box->second, ", "));
}

nlohmann::ordered_json conditions_table(const model::Definition& definition) {
  json rows = json::array();
  for (const model::BoundaryDefinition& boundary : definition.boundaries) append_boundary(rows, boundary);
  for (const model::LoadDefinition& load : definition.loads) append_load(rows, load);
  json columns = json::array();
  for (const char* name : {"name", "where", "what", "value", "over time"}) columns.push_back({{"name", name}});
  return {{"columns", columns}, {"rows", rows}};
}

}  // namespace koshi::report
