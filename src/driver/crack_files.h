// What a run writes of its cracks beside fields: the catalogue, and the surface.
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>

#include "koshi/model.h"

namespace koshi::driver {

/// Writes events.csv, and with output.crack_surface cracks.vtp, as of this state into the output directory
/// (collective); what the summary says of cracks, on the root. Both follow from the state alone, so that a restarted
/// run writes what an uninterrupted one does.
nlohmann::ordered_json write_crack_files(const model::Model& model, model::State& state,
                                         const std::filesystem::path& directory);

}  // namespace koshi::driver
