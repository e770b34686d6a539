#include "driver/stop_criteria.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/choices.h"

namespace koshi::driver {
namespace {

// Size of the reaction of the probe with this name.
double reaction(const model::Model& model, const mechanics::Measurement& measurement, const std::string& name) {
  double squares = 0;
  for (std::size_t p = 0; p < model.probes.size(); ++p) {
    const model::ProbeDefinition& probe = model.probes[p].definition;
    if (probe.name != name || probe.quantity != model::ProbeDefinition::Quantity::reaction) continue;
    for (const double component : measurement.probes[p]) squares += component * component;
  }
  return std::sqrt(squares);
}

// Cells at the face that have cracked through since the run began.
bool cracked_at(const model::Model& model, const model::State& state, model::Face face) {
  const std::size_t axis = static_cast<std::size_t>(face) / 2;
  const std::int64_t layer = static_cast<int>(face) % 2 == 0 ? 0 : model.lattice.grid.cells[axis] - 1;
  bool cracked = false;
  lattice::for_each_owned(model.layout(), [&](auto i, auto j, auto k, auto n) {
    if (model.layout().global({i, j, k})[axis] == layer)
      cracked = cracked || state.crack.component(model::crack_moment)[n] > 0;
  });
  return model.communicator.any(cracked);
}

}  // namespace

std::string reason_to_stop(const model::Model& model, model::State& state, const mechanics::Measurement& measurement) {
  const auto& stop = model.definition.analysis.stop_when;
  if (!stop) return {};
  double force = 0;
  if (!stop->probe.empty()) {
    force = reaction(model, measurement, stop->probe);
    state.peak_force = std::max(state.peak_force, force);
  }
  if (state.time < stop->after) return {};
  if (!stop->probe.empty() && force < stop->below * state.peak_force)
    return fmt::format("the reaction \"{}\" of {:.6g} N is below {:.6g} of its largest, {:.6g} N", stop->probe, force,
                       stop->below, state.peak_force);
  if (stop->face && cracked_at(model, state, *stop->face))
    return fmt::format("a crack has reached the face {}", model::choice_name(*stop->face));
  return {};
}

}  // namespace koshi::driver
