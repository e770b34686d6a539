#include "driver/report_history.h"

#include <algorithm>
#include <string>
#include <vector>

#include "io/report_block.h"

namespace koshi::driver {
namespace {

using json = nlohmann::ordered_json;
using Columns = std::span<const io::HistoryColumn>;

// More curves than this, one picture per probe, belong into the page's own chooser.
constexpr std::size_t most_probe_plots = 4;

json plot(const std::string& title, const std::string& x, const std::vector<std::string>& y, bool log = false) {
  json block{{"title", title}, {"x", x}, {"y", y}};
  if (log) block["log"] = true;
  return block;
}

double spread(const io::HistoryColumn& column) {
  const auto [least, greatest] = std::ranges::minmax(column.values);
  return greatest - least;
}

// The column of a unit that changes most; none when no column changes.
const io::HistoryColumn* liveliest(Columns columns, const std::string& unit) {
  const io::HistoryColumn* best = nullptr;
  for (const io::HistoryColumn& column : columns)
    if (column.unit == unit && spread(column) > (best ? spread(*best) : 0)) best = &column;
  return best;
}

template <class Predicate>
std::vector<std::string> names_where(Columns columns, Predicate&& wanted) {
  std::vector<std::string> names;
  for (const io::HistoryColumn& column : columns)
    if (wanted(column)) names.push_back(column.name);
  return names;
}

}  // namespace

nlohmann::ordered_json history_block(Columns columns, const model::Definition& definition) {
  if (columns.size() < 2 || columns[0].values.size() < 3) return nullptr;
  json block{{"columns", json::array()}, {"plots", json::array()}};
  for (const io::HistoryColumn& column : columns)
    block["columns"].push_back({{"name", column.name}, {"unit", column.unit}, {"data", io::encoded(column.values)}});
  const std::string& time = columns[0].name;
  json& plots = block["plots"];

  const io::HistoryColumn* displacement = liveliest(columns, "m");
  const io::HistoryColumn* force = liveliest(columns, "N");
  if (displacement && force) plots.push_back(plot("Force against displacement", displacement->name, {force->name}));

  if (const auto energies = names_where(columns, [](const auto& column) { return column.unit == "J"; });
      !energies.empty())
    plots.push_back(plot("Energy", time, energies));
  if (const auto ratios = names_where(columns, [](const auto& c) { return c.name.starts_with("unbalanced"); });
      !ratios.empty())
    plots.push_back(plot("Unbalanced force", time, ratios, true));

  for (const model::ProbeDefinition& probe : definition.probes) {
    const auto own =
        names_where(columns, [&](const auto& column) { return column.name.starts_with(probe.name + "."); });
    if (!own.empty() && plots.size() < 3 + most_probe_plots) plots.push_back(plot(probe.name, time, own));
  }
  return block;
}

}  // namespace koshi::driver
