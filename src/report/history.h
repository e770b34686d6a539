// Curves of a report: the columns of the history and which of them the page draws first.
#pragma once

#include <nlohmann/json.hpp>
#include <span>

#include "io/history_reader.h"
#include "koshi/definition.h"

namespace koshi::report {

/// The data block's `history` (docs/formats/report-data.md): all columns, and plots of force against displacement where
/// a boundary moves what a probe measures the reaction of (its displacement is one more column) or probes measure both,
/// of the energies, of the unbalanced force and of each probe over time. Null with fewer than three rows: a static run
/// has nothing to draw.
nlohmann::ordered_json history_block(std::span<const io::HistoryColumn> columns, const model::Definition& definition);

}  // namespace koshi::report
