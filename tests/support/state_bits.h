// A fingerprint of displacements, to compare runs on different numbers of ranks bit by bit.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "driver/simulation.h"

namespace koshi::test {

/// For each component the sum over all nodes of the bits of its value times an odd number that depends on the node,
/// modulo 2^64 (collective): equal for equal fields, whatever the ranks.
inline std::vector<std::int64_t> bits_of(driver::Simulation& simulation) {
  const model::Model& model = simulation.model();
  const Int3 n = model.lattice.grid.nodes();
  std::vector<std::int64_t> sums;
  for (int c = 0; c < model.components(); ++c) {
    std::uint64_t sum = 0;
    lattice::for_each_owned(model.layout(), [&](auto i, auto j, auto k, auto at) {
      const Int3 g = model.layout().global({i, j, k});
      const auto number = static_cast<std::uint64_t>(g[0] + n[0] * (g[1] + n[1] * g[2]));
      sum += (2 * number * 0x9e3779b97f4a7c15 + 1) *
             std::bit_cast<std::uint64_t>(simulation.state().displacement.component(c)[at] + 0.0);
    });
    sums.push_back(std::bit_cast<std::int64_t>(sum));
  }
  model.communicator.sum(sums);
  return sums;
}

}  // namespace koshi::test
