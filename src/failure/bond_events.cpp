#include "failure/bond_events.h"

#include <algorithm>
#include <limits>

#include "base/exact_sum.h"

namespace koshi::failure {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();
// Bonds this close to the first one go with it: symmetric ones differ by the solver's tolerance.
constexpr double tie = 1e-3;

}  // namespace

BondEvents::BondEvents(BondBreaking& breaking, model::Model& model, model::State& state)
    : breaking_(breaking),
      model_(model),
      state_(state),
      broken_(breaking, model, state),
      bonds_(breaking, model),
      load_(state.displacement) {}

// How far nodes have moved apart along an axis, over the longest side of the body.
double BondEvents::spread() const {
  const Int3& cells = model_.lattice.grid.cells;
  const double side = model_.lattice.grid.d * static_cast<double>(std::max({cells[0], cells[1], cells[2]}));
  double most = 0;
  for (int c = 0; c < 3; ++c) {
    double lo = never, hi = -never;
    lattice::for_each_owned(model_.layout(), [&](auto, auto, auto, auto n) {
      if (!(model_.inertia.component(0)[n] > 0)) return;
      lo = std::min(lo, state_.displacement.component(c)[n]);
      hi = std::max(hi, state_.displacement.component(c)[n]);
    });
    most = std::max(most, model_.communicator.max(hi) - model_.communicator.min(lo));
  }
  return most / side;
}

double BondEvents::next() {
  const double strained = bonds_.look(1 - tie);
  double factor = strained > 0 ? 1 / strained : never;
  // Stretches that are only rounding of a body under pressure would ask for more.
  if (factor < never && factor * spread() > 1) factor = never;
  breaks_ = true;

  // The load at which the bonds of the last event have taken on the straight way from it what they held.
  ExactSum held, lost;
  for (const std::int64_t n : breaking_.cracked_) {
    if (breaking_.fresh(n) == 0 || !model_.layout().owns(model_.layout().place(n))) continue;
    held += broken_.energy_held(n);
    lost += broken_.energy_lost(n);
  }
  for (ExactSum* sum : {&held, &lost}) sum->sum_ranks(model_.communicator);
  if (lost.value() > 0 && held.value() < factor * lost.value()) {
    breaks_ = false;
    factor = held.value() / lost.value();
  }
  return factor;
}

void BondEvents::go(double factor) {
  load_.go(factor);
  broken_.update();
  for (const std::int64_t n : breaking_.cracked_)
    if (breaking_.fresh(n) != 0) breaking_.break_in_cell(n, broken_.energy_lost(n));
}

bool BondEvents::soften() {
  breaking_.make_lattice_follow();
  broken_.note();
  if (!breaks_) return false;
  bonds_.break_them();
  broken_.renew();
  return true;
}

}  // namespace koshi::failure
