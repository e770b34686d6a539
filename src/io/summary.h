// The results of a run at its end, and the input it ran with (docs/formats/output.md).
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "koshi/communicator.h"

namespace koshi::io {

/// Writes `summary.json` into the output directory (collective; the root's summary counts). Numbers are written so that
/// reading them back gives the same double; what is not a finite number becomes null. Throws RunError with the system's
/// reason on all ranks; an earlier file then stays as it was.
void write_summary(const Communicator& communicator, const std::filesystem::path& directory,
                   const nlohmann::ordered_json& summary);

/// Writes a table of numbers as CSV likewise: names with units, then rows as long. Numbers are the shortest that read
/// back as the same double.
void write_table(const Communicator& communicator, const std::filesystem::path& file,
                 const std::vector<std::string>& columns, const std::vector<std::vector<double>>& rows);

/// Writes `resolved.toml` likewise.
void write_resolved(const Communicator& communicator, const std::filesystem::path& directory, std::string_view toml);

}  // namespace koshi::io
