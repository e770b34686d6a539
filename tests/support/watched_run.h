// A run in motion whose bodies break, watched row by row.
#pragma once

#include <algorithm>
#include <cmath>

#include "driver/simulation.h"

namespace koshi::test {

// Energies of a run must add up in every row: what cells store and move, what damping and cracks took, is what loads
// and supports gave.
struct Watched {
  double peak = 0, last = 0, unbalanced = 0;
  int rows = 0;
  mechanics::Balance end;
};

inline Watched watch(const model::Definition& definition) {
  driver::Simulation simulation(definition, Communicator::world());
  Watched seen;
  driver::Observer observer;
  double largest = 0, gap = 0;
  observer.history = [&](const mechanics::Measurement& at, model::State&) {
    const mechanics::Balance& b = at.balance;
    seen.last = at.probes[0][0];
    seen.peak = std::max(seen.peak, at.probes[0][0]);
    largest = std::max(largest, std::abs(b.given));
    gap = std::max(gap, std::abs(b.leapfrog_energy + b.damped + b.cracked - b.given));
    seen.end = b;
    ++seen.rows;
  };
  simulation.run(observer);
  seen.unbalanced = gap / largest;
  return seen;
}

}  // namespace koshi::test
