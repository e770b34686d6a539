// The catalogue of what broke: cells that crack through one after the other, put together to events.
#pragma once

#include <nlohmann/json.hpp>

#include <span>
#include <string>
#include <vector>

#include "driver/cracked_cells.h"

namespace koshi::driver {

struct CrackEvent {
  double time = 0;      ///< of its first cell [s]
  double duration = 0;  ///< from its first cell to its last [s]
  Vec3 place{};         ///< mean of its cells' centres [m]
  double energy = 0;    ///< that its cells have taken so far [J]
  std::int64_t cells = 0;
  double shear = 0;  ///< part of its cells that the shear limit began

  /// (log10 E - 4.8)/1.5 of Gutenberg and Richter; -infinity of no energy.
  double magnitude() const;
};

/// Time within which cracks of neighbouring cells belong together [s]: in which a shear wave crosses ten cells of the
/// slowest material that cracks.
double event_window(const model::Model& model);

/// Two cells that share a corner and crack through within the window of each other belong to one event, and so do all
/// that hang together by such pairs. By time, then by the number of the first cell. Cells that were cracked before the
/// run are left out.
std::vector<CrackEvent> crack_events(const lattice::Grid& grid, std::span<const CrackedCell> cells, double window);

/// Columns and rows of events.csv (docs/formats/output.md).
std::vector<std::string> event_columns();
std::vector<std::vector<double>> event_rows(std::span<const CrackEvent> events);

/// Entry of the summary: number, energy, largest magnitude and b-value, which is null for fewer than 20 events.
nlohmann::ordered_json events_summary(std::span<const CrackEvent> events);

}  // namespace koshi::driver
