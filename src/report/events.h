// Curves of what broke.
#pragma once

#include <nlohmann/json.hpp>
#include <span>

#include "io/history_reader.h"

namespace koshi::report {

/// Two plots for the data block's `curves`, from the columns of events.csv, the first of which says when: how many
/// events are as large as a magnitude, with the line of the b-value where there is one, and the energy of events over
/// time. Empty without events. `b_value`: of the summary, null for none.
nlohmann::ordered_json event_curves(std::span<const io::HistoryColumn> events, const nlohmann::ordered_json& b_value);

}  // namespace koshi::report
