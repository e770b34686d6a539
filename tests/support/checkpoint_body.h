// A small body and states of it for the checkpoint tests.
#pragma once

#include <bit>
#include <cstdint>

#include "io/checkpoint.h"
#include "koshi/model.h"

namespace koshi::test {

inline model::Definition checkpoint_definition(bool periodic = false, double spacing = 0.25) {
  model::Definition definition;
  definition.lattice.spacing = spacing;
  definition.body.size = {1.75, 1.25, 1.5};  // 7 x 5 x 6 cells
  definition.body.periodic = {false, false, periodic};
  definition.body.material = "rock";
  definition.materials = {{"rock", {1e9, 0.2, 1000}}};
  return definition;
}

/// Any bit pattern may occur in a state: every component of every node gets its own, infinities and NaNs included.
inline double checkpoint_value(int component, const Int3& node, std::int64_t step) {
  std::uint64_t bits = static_cast<std::uint64_t>(component + 16 * (node[0] + 16 * (node[1] + 16 * node[2]))) + 1;
  for (int round = 0; round < 3; ++round)
    bits = (bits ^ (bits >> 31)) * 0x9E3779B97F4A7C15u + static_cast<std::uint64_t>(step);
  return std::bit_cast<double>(bits);
}

template <class F>
void for_each_value(const model::Model& model, lattice::Field<double>& field, F&& f) {
  lattice::for_each_owned(model.layout(), [&](auto i, auto j, auto k, auto n) {
    for (int c = 0; c < field.components(); ++c) f(c, model.layout().global({i, j, k}), field.component(c)[n]);
  });
}

inline void fill(const model::Model& model, lattice::Field<double>& field, std::int64_t step) {
  for_each_value(model, field, [&](int c, const Int3& node, double& v) { v = checkpoint_value(c, node, step); });
}

/// Number of owned values that are, bit for bit, those of fill().
inline std::int64_t count_filled(const model::Model& model, lattice::Field<double>& field, std::int64_t step) {
  std::int64_t count = 0;
  for_each_value(model, field, [&](int c, const Int3& node, double& v) {
    count += std::bit_cast<std::uint64_t>(v) == std::bit_cast<std::uint64_t>(checkpoint_value(c, node, step));
  });
  return count;
}

/// The state of a step: displacement as of the step, velocity as of the negative step.
inline void fill(const model::Model& model, model::State& state, std::int64_t step) {
  state.step = step;
  state.time = 0.1 * static_cast<double>(step);
  fill(model, state.displacement, step);
  fill(model, state.velocity, -step);
}

inline bool is_filled(const model::Model& model, model::State& state, std::int64_t step) {
  const std::int64_t all = model.layout().owned_count() * model.components();
  return state.step == step && state.time == 0.1 * static_cast<double>(step) &&
         count_filled(model, state.displacement, step) == all && count_filled(model, state.velocity, -step) == all;
}

}  // namespace koshi::test
