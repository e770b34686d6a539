// The catalogue of what broke: cells that crack through one after the other, put together to events.
#pragma once

#include <nlohmann/json.hpp>

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "driver/cracked_cells.h"

namespace koshi::driver {

struct CrackEvent {
  double time = 0;      ///< moment of its first cell: [s], in equilibrium the number of an equilibrium
  double duration = 0;  ///< from its first cell to its last
  Vec3 place{};         ///< mean of its cells' centres [m]
  double energy = 0;    ///< that its cells have taken so far [J]
  std::int64_t cells = 0;
  double shear = 0;  ///< part of its cells that the shear limit began

  /// (log10 E - 4.8)/1.5 of Gutenberg and Richter; -infinity of no energy.
  double magnitude() const;
};

/// Whether two cells that share a corner and crack through at these moments belong to one event.
using Together = std::function<bool(double, double)>;

/// In motion: within the time in which a shear wave crosses ten cells of the slowest material that cracks.
Together within_window(const model::Model& model);

/// In equilibrium, where moments are numbers of equilibria, by their load factors: what cracks from one largest factor
/// so far to the next would break all at once under loads that only rise.
Together within_one_rise(std::span<const double> load_factors);

/// In equilibrium by steps of the loads, where moments are the times of steps: what cracks in one step.
Together within_one_step();

/// Cells that belong together, and all that hang together by such pairs, are one event. By time, then by the number of
/// the first cell. Cells that were cracked before the run are left out.
std::vector<CrackEvent> crack_events(const lattice::Grid& grid, std::span<const CrackedCell> cells,
                                     const Together& together);

/// Columns and rows of events.csv (docs/formats/output.md). Load factors by number of equilibrium; none in motion.
std::vector<std::string> event_columns(std::span<const double> load_factors);
std::vector<std::vector<double>> event_rows(std::span<const CrackEvent> events, std::span<const double> load_factors);

/// Entry of the summary: number, energy, largest magnitude and b-value, which is null for fewer than 20 events.
nlohmann::ordered_json events_summary(std::span<const CrackEvent> events);

}  // namespace koshi::driver
