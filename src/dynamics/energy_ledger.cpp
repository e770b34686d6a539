#include "dynamics/energy_ledger.h"

#include <algorithm>

namespace koshi::dynamics {

EnergyLedger::EnergyLedger(const model::Model& model, model::State& state, const mechanics::RowIndex& motion_rows,
                           double dt)
    : model_(model),
      state_(state),
      motion_rows_(motion_rows),
      dt_(dt),
      damping_(model.definition.analysis.damping.kind != model::DampingDefinition::Kind::none) {
  for (auto* rows : {&internal_, &velocity_})
    for (auto& row : *rows) row.resize(static_cast<std::size_t>(model.layout().owned()[0]) + row_width);
}

void EnergyLedger::open(std::int64_t j, std::int64_t k, double* const* force, bool loaded) {
  const std::int64_t n = model_.layout().index(0, j, k), count = model_.layout().owned()[0];
  loaded_ = loaded;
  for (int c = 0; c < model_.components(); ++c) {
    const auto a = static_cast<std::size_t>(c);
    if (loaded) std::copy_n(force[c], count, internal_[a].begin());
    std::copy_n(state_.velocity.component(c) + n, count, velocity_[a].begin());
  }
}

void EnergyLedger::close(std::int64_t j, std::int64_t k, double* const* force) {
  const std::int64_t n = model_.layout().index(0, j, k), count = model_.layout().owned()[0];
  double *const given_row = state_.work.component(given) + n, *const damped_row = state_.work.component(damped) + n;
  for (int c = 0; c < model_.components(); ++c) {
    const double* const before = velocity_[static_cast<std::size_t>(c)].data();
    const double* const after = state_.velocity.component(c) + n;
    if (loaded_)
      update_.work(dt_, count, force[c], internal_[static_cast<std::size_t>(c)].data(), before, after, given_row);
    if (damping_)
      update_.damp(dt_, count, force[c], model_.inertia.component(c < 3 ? 0 : 1) + n, before, after, damped_row);
  }

  // On prescribed components it was the support.
  const std::int64_t row = j + model_.layout().owned()[1] * k;
  for (std::size_t m = motion_rows_.begin(row); m < motion_rows_.end(row); ++m) {
    const model::PrescribedMotion& motion = model_.motions[m];
    const std::int64_t i = motion.node - n;
    const int c = motion.component;
    const double before = velocity_[static_cast<std::size_t>(c)][static_cast<std::size_t>(i)];
    const double after = state_.velocity.component(c)[motion.node];
    const double inertia = model_.inertia.component(c < 3 ? 0 : 1)[motion.node];
    const double work = (inertia * (after - before) - dt_ * force[c][i]) * (0.5 * (before + after));
    given_row[i] += work;
    if (damping_) damped_row[i] += work;
  }
}

}  // namespace koshi::dynamics
