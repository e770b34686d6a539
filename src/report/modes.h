// Modes on the page: what their samples are called, and their table.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace koshi::report {

/// What the page calls the modes, by their number: "mode 3, 440 Hz".
std::map<int, std::string> mode_labels(const nlohmann::ordered_json& summary);

/// Frequencies, modal masses and the parts of the body's mass that each mode moves along x, y and z; null without
/// modes.
nlohmann::ordered_json modes_table(const nlohmann::ordered_json& summary);

}  // namespace koshi::report
