// Tables of a report: what was computed, with which springs, and what came out (docs/formats/report-data.md).
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "koshi/definition.h"

namespace koshi::report {

/// A line that says what kind of computation it was: cell, springs, calibration, kinematics, analysis.
std::string report_subtitle(const model::Definition& definition);

nlohmann::ordered_json materials_table(const model::Definition& definition);

/// Springs of every material by bond family, as the summary has them, and the elastic constants that the calibration
/// gives beside those asked for.
struct SpringTables {
  nlohmann::ordered_json springs;
  nlohmann::ordered_json achieved;
};
SpringTables spring_tables(const model::Definition& definition, const nlohmann::ordered_json& summary);

/// A table for each quantity that the summary's probes hold.
nlohmann::ordered_json probe_tables(const model::Definition& definition, const nlohmann::ordered_json& summary);

/// A table for each of the summary's parts "analysis", "energy" and "performance".
nlohmann::ordered_json run_tables(const nlohmann::ordered_json& summary);

}  // namespace koshi::report
