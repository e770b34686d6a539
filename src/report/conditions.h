// What a report says of a body's supports, prescribed motions and loads (docs/formats/report-data.md).
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "koshi/definition.h"

namespace koshi::report {

/// Where a selection lies: "y-max", "box (0, 0, 0) to (1, 1, 0) m", "point (0, 0, 1) m"; "whole body" for none.
std::string place_text(const model::Selection& selection);

/// A row for what each boundary holds fixed, for each component it moves, and for each load.
nlohmann::ordered_json conditions_table(const model::Definition& definition);

}  // namespace koshi::report
