#include "driver/mode_tables.h"

#include <fmt/format.h>

#include <array>

#include "model/choices.h"

namespace koshi::driver {
namespace {

using Json = nlohmann::ordered_json;

// Share of what all modes and rigid motions have together; 0 where there is nothing to share.
double share(double part, double total) { return total > 0 ? part / total : 0; }

}  // namespace

std::vector<std::string> mode_columns() {
  std::vector<std::string> columns{"mode", "frequency [Hz]", "residual [1]", "modal mass [kg]"};
  for (int a = 0; a < 6; ++a)
    columns.push_back(fmt::format("participation {} [{}]", model::component_names[a], a < 3 ? "1" : "m"));
  for (int a = 0; a < 6; ++a)
    columns.push_back(fmt::format("effective mass {} [{}]", model::component_names[a], a < 3 ? "kg" : "kg m^2"));
  return columns;
}

std::vector<std::vector<double>> mode_rows(const modes::ModesReport& report) {
  std::vector<std::vector<double>> rows;
  for (const modes::Mode& mode : report.modes) {
    auto& row = rows.emplace_back(
        std::vector<double>{static_cast<double>(mode.number), mode.frequency, mode.residual, mode.modal_mass});
    row.insert(row.end(), mode.participation.begin(), mode.participation.end());
    row.insert(row.end(), mode.effective_mass.begin(), mode.effective_mass.end());
  }
  return rows;
}

nlohmann::ordered_json modes_analysis(const modes::ModesReport& report) {
  Json entry{{"unknowns", report.unknowns},
             {"iterations", report.iterations},
             {"levels", report.levels},
             {"modes_searched", report.searched},
             {"converged", !report.stopped},
             {"projected_motions", report.projected_motions},
             {"centre_of_mass", report.centre_of_mass},
             {"total_effective_mass", report.total_effective_mass},
             {"rigid_effective_mass", report.rigid_effective_mass}};
  if (!report.free_motions.empty()) entry["free_motions"] = report.free_motions;
  return entry;
}

nlohmann::ordered_json modes_summary(const modes::ModesReport& report) {
  Json list = Json::array();
  for (const modes::Mode& mode : report.modes)
    list.push_back({{"mode", mode.number},
                    {"frequency", mode.frequency},
                    {"residual", mode.residual},
                    {"modal_mass", mode.modal_mass},
                    {"participation", mode.participation},
                    {"effective_mass", mode.effective_mass}});
  return list;
}

std::string modes_text(const modes::ModesReport& report, double seconds) {
  if (report.stopped) return "the search for modes was stopped\n";
  std::string text = fmt::format("{} modes of {} unknowns in {} iterations, {:.3g} s\n", report.modes.size(),
                                 report.unknowns, report.iterations, seconds);
  if (!report.free_motions.empty()) text += fmt::format("  {}; modes are without that motion\n", report.free_motions);
  text += fmt::format("  mode  {:>14}  {:>9}  {:>12}  {:>23}\n", "frequency [Hz]", "residual", "modal m [kg]",
                      "effective mass x, y, z");
  std::array<double, 3> sum{};
  for (const modes::Mode& mode : report.modes) {
    text += fmt::format("  {:4}  {:14.6g}  {:9.1e}  {:12.4g}  ", mode.number, mode.frequency, mode.residual,
                        mode.modal_mass);
    for (std::size_t a = 0; a < 3; ++a) {
      const double part = share(mode.effective_mass[a], report.total_effective_mass[a]);
      sum[a] += part;
      text += fmt::format(" {:5.1f} %", 100 * part);
    }
    text += '\n';
  }
  text += fmt::format("  {:47}  ", "together");
  for (const double part : sum) text += fmt::format(" {:5.1f} %", 100 * part);
  return text + '\n';
}

}  // namespace koshi::driver
