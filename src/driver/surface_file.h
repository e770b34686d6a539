// The surface of the regions as a file, with fields on it.
#pragma once

#include <filesystem>

#include "koshi/model.h"

namespace koshi::driver {

/// Writes surface.vtp as of this state into the output directory (collective): the pieces of the regions' surfaces that
/// are surface of the body, with the displacement and the stress there.
void write_surface(const model::Model& model, model::State& state, const std::filesystem::path& directory);

}  // namespace koshi::driver
