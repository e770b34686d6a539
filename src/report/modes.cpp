#include "report/modes.h"

#include <fmt/format.h>

namespace koshi::report {
namespace {

using json = nlohmann::ordered_json;

json modes_of(const json& summary) { return summary.value("modes", json::array()); }

}  // namespace

std::map<int, std::string> mode_labels(const nlohmann::ordered_json& summary) {
  std::map<int, std::string> labels;
  for (const json& mode : modes_of(summary)) {
    const int number = mode.at("mode");
    labels[number] = fmt::format("mode {}, {:.6g} Hz", number, mode.at("frequency").get<double>());
  }
  return labels;
}

nlohmann::ordered_json modes_table(const nlohmann::ordered_json& summary) {
  const json modes = modes_of(summary);
  if (modes.empty()) return {};
  json table{{"title", "Modes"},
             {"columns",
              {{{"name", "mode"}, {"decimals", 0}},
               {{"name", "frequency"}, {"unit", "Hz"}},
               {{"name", "residual"}},
               {{"name", "modal mass"}, {"unit", "kg"}},
               {{"name", "moved along x"}, {"unit", "kg"}},
               {{"name", "moved along y"}, {"unit", "kg"}},
               {{"name", "moved along z"}, {"unit", "kg"}}}},
             {"rows", json::array()},
             {"note", "A shape's largest displacement is 1 m. What it moves along an axis is its effective mass."}};
  for (const json& mode : modes) {
    json row{mode.at("mode"), mode.at("frequency"), mode.at("residual"), mode.at("modal_mass")};
    const json& moved = mode.at("effective_mass");
    for (std::size_t axis = 0; axis < 3; ++axis) row.push_back(moved.at(axis));
    table["rows"].push_back(row);
  }
  return table;
}

}  // namespace koshi::report
