#include "report/events.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace koshi::report {
namespace {

using json = nlohmann::ordered_json;

std::vector<double> column(std::span<const io::HistoryColumn> events, const std::string& name) {
  const auto found = std::ranges::find(events, name, &io::HistoryColumn::name);
  return found == events.end() ? std::vector<double>{} : found->values;
}

json series(const std::string& name, const std::vector<double>& x, const std::vector<double>& y, const char* style) {
  return {{"name", name}, {"x", x}, {"y", y}, {"style", style}};
}

json magnitudes(std::vector<double> magnitude, const json& b_value) {
  std::ranges::sort(magnitude);
  const double count = static_cast<double>(magnitude.size());
  std::vector<double> as_large(magnitude.size());
  for (std::size_t e = 0; e < magnitude.size(); ++e) as_large[e] = count - static_cast<double>(e);
  json all = json::array({series("events", magnitude, as_large, "points")});
  if (b_value.is_number()) {
    // Down to one event.
    const double least = magnitude.front(), b = b_value.get<double>();
    all.push_back(series("b-value", {least, least + std::log10(count) / b}, {count, 1}, "dashed"));
  }
  return {{"title", "Number of events as large or larger"},
          {"x", {{"label", "magnitude"}}},
          {"y", {{"label", "events"}, {"log", true}}},
          {"series", all}};
}

json energies(const io::HistoryColumn& when, const std::vector<double>& energy) {
  std::vector<double> sum(energy.size());
  double so_far = 0;
  for (std::size_t e = 0; e < energy.size(); ++e) sum[e] = so_far += energy[e];
  return {{"title", "Energy of events"},
          {"x", {{"label", when.name}, {"unit", when.unit == "1" ? "" : when.unit}}},
          {"y", {{"label", "energy so far"}, {"unit", "J"}}},
          {"series", json::array({series("events", when.values, sum, "line+points")})}};
}

}  // namespace

nlohmann::ordered_json event_curves(std::span<const io::HistoryColumn> events, const json& b_value) {
  if (events.empty() || events[0].values.empty()) return json::array();
  const std::vector<double> energy = column(events, "energy"), magnitude = column(events, "magnitude");
  if (energy.size() != events[0].values.size() || magnitude.size() != energy.size()) return json::array();
  return json::array({magnitudes(magnitude, b_value), energies(events[0], energy)});
}

}  // namespace koshi::report
