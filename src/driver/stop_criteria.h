// What ends a run before its time: analysis.stop_when.
#pragma once

#include <string>

#include "koshi/model.h"
#include "mechanics/measure.h"

namespace koshi::driver {

/// Looks at a sample of the history, and keeps the largest reaction in the state. Returns why the run is to end, empty
/// if it is not (collective; equal on any number of ranks).
std::string reason_to_stop(const model::Model& model, model::State& state, const mechanics::Measurement& measurement);

}  // namespace koshi::driver
