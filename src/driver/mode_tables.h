// Modes as tables: for people, programs and the summary.
#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

#include "koshi/modes.h"

namespace koshi::driver {

/// Columns and rows of modes.csv (docs/formats/output.md).
std::vector<std::string> mode_columns();
std::vector<std::vector<double>> mode_rows(const modes::ModesReport& report);

/// Entries of the summary: `analysis`, and the list `modes`.
nlohmann::ordered_json modes_analysis(const modes::ModesReport& report);
nlohmann::ordered_json modes_summary(const modes::ModesReport& report);

/// A table for the terminal.
std::string modes_text(const modes::ModesReport& report, double seconds);

}  // namespace koshi::driver
