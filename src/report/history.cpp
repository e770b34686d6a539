#include "report/history.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "io/report_block.h"
#include "koshi/model.h"
#include "model/choices.h"

namespace koshi::report {
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

// Displacement [m] of component c that a boundary prescribes at these times; a velocity is summed up by the trapezoidal
// rule, exact while it is constant.
std::vector<double> prescribed(const model::BoundaryDefinition& boundary, std::size_t c,
                               const std::vector<double>& times) {
  std::vector<double> values;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double now = model::factor(boundary, times[i]);
    if (boundary.displacement[c])
      values.push_back(*boundary.displacement[c] * now);
    else if (i == 0)
      values.push_back(0);
    else
      values.push_back(values.back() + *boundary.velocity[c] * 0.5 * (model::factor(boundary, times[i - 1]) + now) *
                                           (times[i] - times[i - 1]));
  }
  return values;
}

/// A face, box or point that is moved and whose reaction a probe measures.
struct Press {
  io::HistoryColumn displacement;
  std::string force;  ///< name of the reaction's column
};

// The first press of the case, with the component in which it moves.
std::optional<Press> find_press(Columns columns, const model::Definition& definition) {
  for (const model::ProbeDefinition& probe : definition.probes)
    for (const model::BoundaryDefinition& boundary : definition.boundaries) {
      if (probe.quantity != model::ProbeDefinition::Quantity::reaction || probe.selection != boundary.selection)
        continue;
      for (std::size_t c = 0; c < 3; ++c) {
        if (!boundary.displacement[c] && !boundary.velocity[c]) continue;
        const std::string_view component = model::component_names[c];
        Press press{{fmt::format("{} displacement {}", boundary.name.empty() ? probe.name : boundary.name, component),
                     "m", prescribed(boundary, c, columns[0].values)},
                    fmt::format("{}.reaction.{}", probe.name, component)};
        const bool measured =
            std::ranges::any_of(columns, [&](const auto& column) { return column.name == press.force; });
        if (measured && spread(press.displacement) > 0) return press;
      }
    }
  return std::nullopt;
}

}  // namespace

nlohmann::ordered_json history_block(Columns measured, const model::Definition& definition) {
  if (measured.size() < 2 || measured[0].values.size() < 3) return nullptr;
  std::vector<io::HistoryColumn> columns(measured.begin(), measured.end());
  const std::optional<Press> press = find_press(measured, definition);
  if (press) columns.push_back(press->displacement);
  json block{{"columns", json::array()}, {"plots", json::array()}};
  for (const io::HistoryColumn& column : columns)
    block["columns"].push_back({{"name", column.name}, {"unit", column.unit}, {"data", io::encoded(column.values)}});
  const std::string& time = columns[0].name;
  json& plots = block["plots"];

  // Where nothing is pressed, the liveliest of what probes measure.
  const io::HistoryColumn* displacement = liveliest(columns, "m");
  const io::HistoryColumn* force = liveliest(columns, "N");
  if (press)
    plots.push_back(plot("Force against displacement", press->displacement.name, {press->force}));
  else if (displacement && force)
    plots.push_back(plot("Force against displacement", displacement->name, {force->name}));

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

}  // namespace koshi::report
