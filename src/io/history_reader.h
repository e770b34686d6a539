// Reads back `history.csv` (docs/formats/output.md).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace koshi::io {

/// A column of the history: "tip.displacement.x [m]" has the name "tip.displacement.x" and the unit "m".
struct HistoryColumn {
  std::string name;
  std::string unit;  ///< "1" where the header gives none
  std::vector<double> values;
};

/// All columns with the rows that are whole; a last row cut short is left out. Throws InputError, with file and line,
/// when the file cannot be read or a value is no number.
std::vector<HistoryColumn> read_history(const std::filesystem::path& path);

}  // namespace koshi::io
