// Equilibrium of a periodic body whose mean strain, or the mean stress that leads to it, is given.
#pragma once

#include "koshi/statics.h"

namespace koshi::statics {

/// What solve_static() does for a definition with [macroscopic] (collective). Errors: as there.
SolveReport solve_macroscopic(const model::Model& model, model::State& state, const StaticOptions& options);

}  // namespace koshi::statics
