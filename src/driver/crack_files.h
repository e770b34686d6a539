// What a run writes of its cracks beside fields: the catalogue, and the surface.
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <span>

#include "koshi/model.h"

namespace koshi::driver {

/// Writes events.csv, and with output.crack_surface cracks.vtp, as of this state into the output directory
/// (collective); what the summary says of cracks, on the root. Of a run in motion both follow from the state alone, so
/// that a restarted run writes what an uninterrupted one does. In equilibrium its events come with their load factors,
/// by number; none in motion.
nlohmann::ordered_json write_crack_files(const model::Model& model, model::State& state,
                                         std::span<const double> load_factors, const std::filesystem::path& directory);

}  // namespace koshi::driver
