#include "dynamics/mean_strain.h"

#include "mechanics/uniform_strain.h"

namespace koshi::dynamics {

using mechanics::Tensor6;

MeanStrain::MeanStrain(const model::Model& model, model::State& state) : model_(model), state_(state) {
  if (!model_.definition.macroscopic) return;
  const bool at_start = state.step == 0 && state.time == 0;
  state_.mean_strain = at_start ? Tensor6{} : mechanics::given_strain(model_.definition, state_.time);
}

void MeanStrain::follow() {
  if (!model_.definition.macroscopic) return;
  const Tensor6 strain = mechanics::given_strain(model_.definition, state_.time);
  Tensor6 added;
  for (std::size_t c = 0; c < 6; ++c) added[c] = strain[c] - state_.mean_strain[c];
  mechanics::add_uniform_strain(model_, added, state_.displacement);
  state_.mean_strain = strain;
}

void MeanStrain::continue_ghosts() { mechanics::add_periods(model_, state_.mean_strain, state_.displacement); }

}  // namespace koshi::dynamics
