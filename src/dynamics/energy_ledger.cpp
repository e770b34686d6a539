#include "dynamics/energy_ledger.h"

#include <algorithm>
#include <cmath>

namespace koshi::dynamics {

EnergyLedger::EnergyLedger(const model::Model& model, model::State& state, const mechanics::RowIndex& motion_rows,
                           const Kick& kick, double dt)
    : model_(model),
      state_(state),
      motion_rows_(motion_rows),
      kick_(kick),
      dt_(dt),
      damping_(model.definition.analysis.damping.kind != model::DampingDefinition::Kind::none) {
  const auto nodes = static_cast<std::size_t>(model.layout().owned()[0]) + row_width;
  for (auto* rows : {&internal_, &velocity_})
    for (auto& row : *rows) row.resize(nodes);
  damped_.resize(nodes);
}

void EnergyLedger::open(std::int64_t j, std::int64_t k, double* const* force, bool loaded) {
  const std::int64_t n = model_.layout().index(0, j, k), count = model_.layout().owned()[0];
  const std::int64_t row = j + model_.layout().owned()[1] * k;
  loaded_ = loaded;
  supported_ = motion_rows_.begin(row) != motion_rows_.end(row);
  if (!loaded_ && !supported_) return;
  for (int c = 0; c < model_.components(); ++c) {
    const auto a = static_cast<std::size_t>(c);
    if (loaded) std::copy_n(force[c], count, internal_[a].begin());
    std::copy_n(state_.velocity.component(c) + n, count, velocity_[a].begin());
  }
  if (damping_ && supported_) std::copy_n(state_.work.component(damped) + n, count, damped_.begin());
}

void EnergyLedger::kick(int c, std::int64_t n, const double* force, const double* inverse_inertia) {
  const std::int64_t count = model_.layout().owned()[0];
  double* const velocity = state_.velocity.component(c) + n;
  if (damping_)
    update_.kick_and_count(kick_, dt_, count, force, inverse_inertia, model_.inertia.component(c < 3 ? 0 : 1) + n,
                           velocity, state_.work.component(damped) + n);
  else
    update_.kick(kick_, count, force, inverse_inertia, velocity);
}

void EnergyLedger::close(std::int64_t j, std::int64_t k, double* const* force) {
  const std::int64_t n = model_.layout().index(0, j, k), count = model_.layout().owned()[0];
  double* const given_row = state_.work.component(given) + n;
  if (loaded_)
    for (int c = 0; c < model_.components(); ++c) {
      const auto a = static_cast<std::size_t>(c);
      update_.work(dt_, count, force[c], internal_[a].data(), velocity_[a].data(), state_.velocity.component(c) + n,
                   given_row);
    }
  if (!supported_) return;

  // What changed the momentum of prescribed components beside the forces was the support, not damping.
  const std::int64_t row = j + model_.layout().owned()[1] * k;
  const std::size_t last = motion_rows_.end(row);
  for (std::size_t m = motion_rows_.begin(row); m < last;) {
    const std::size_t first = m;
    const std::int64_t node = model_.motions[first].node, i = node - n;
    for (; m < last && model_.motions[m].node == node; ++m) {
      const int c = model_.motions[m].component;
      const double before = velocity_[static_cast<std::size_t>(c)][static_cast<std::size_t>(i)];
      const double after = state_.velocity.component(c)[node];
      given_row[i] += (inertia(c, node) * (after - before) - dt_ * force[c][i]) * (0.5 * (before + after));
    }
    if (damping_)
      state_.work.component(damped)[node] = damped_[static_cast<std::size_t>(i)] + damped_in_free(first, m, i, force);
  }
}

// What damping took on the components of node i that none of these motions prescribes.
double EnergyLedger::damped_in_free(std::size_t first, std::size_t end, std::int64_t i, double* const* force) const {
  unsigned prescribed = 0;
  for (std::size_t m = first; m < end; ++m) prescribed |= 1U << model_.motions[m].component;
  const std::int64_t node = model_.motions[first].node;
  double sum = 0;
  for (int c = 0; c < model_.components(); ++c) {
    if ((prescribed >> c & 1) != 0) continue;
    const double before = velocity_[static_cast<std::size_t>(c)][static_cast<std::size_t>(i)];
    const double after = state_.velocity.component(c)[node], resisting = kick_.alpha * std::abs(force[c][i]);
    const double local = before > 0 ? resisting : before < 0 ? -resisting : 0;
    const double lost = dt_ * local + kick_.drag() * inertia(c, node) * (before + after);
    sum += lost * (0.5 * (before + after));
  }
  return sum;
}

}  // namespace koshi::dynamics
