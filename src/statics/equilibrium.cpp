#include "statics/equilibrium.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/collective.h"
#include "lattice/halo.h"
#include "mechanics/loads.h"
#include "mechanics/uniform_strain.h"

namespace koshi::statics {

Equilibrium::Equilibrium(const model::Model& model, double t, lattice::Field<double>& work)
    : model_(model),
      components_(model.components()),
      node_count_(model.layout().owned_count()),
      t_(t),
      half_d_(0.5 * model.lattice.grid.d),
      work_(work),
      kernel_(model.lattice) {
  const auto& boundaries = model.definition.boundaries;
  collectively(model.communicator, [&] {
    for (const model::PrescribedMotion& motion : model.motions)
      if (motion.is_velocity && motion.value != 0)
        throw InputError(model.definition.places.find(fmt::format("boundary[{}].velocity", motion.boundary)),
                         fmt::format("boundary \"{}\" prescribes a velocity, but a static analysis has no time; "
                                     "prescribe a displacement",
                                     boundaries[static_cast<std::size_t>(motion.boundary)].name));
  });

  // Motions are sorted by node, as the rows are.
  auto motion = model.motions.begin();
  const lattice::Layout& layout = model.layout();
  std::int64_t number = 0;
  lattice::for_each_owned(layout, [&](auto, auto, auto, auto n) {
    for (; motion != model.motions.end() && motion->node == n; ++motion)
      prescribed_.push_back(
          {number + motion->component * node_count_, n, motion->component, motion->boundary, motion->value, 0});
    ++number;
  });
  fixed_ = fixed_nodes(model);
  set_time(t);
}

void Equilibrium::set_time(double t) {
  t_ = t;
  for (Prescribed& p : prescribed_)
    p.value = p.amount * model::factor(model_.definition.boundaries[static_cast<std::size_t>(p.boundary)], t);
}

std::int64_t Equilibrium::unknown_of(std::int64_t j, std::int64_t k) const {
  const Int3& owned = model_.layout().owned();
  return owned[0] * (j + owned[1] * k);
}

void Equilibrium::to_field(const double* x, lattice::Field<double>& field) const {
  const lattice::Layout& layout = model_.layout();
  const Int3& owned = layout.owned();
  for (std::int64_t k = 0; k < owned[2]; ++k)
    for (std::int64_t j = 0; j < owned[1]; ++j)
      for (int c = 0; c < components_; ++c) {
        const double factor = 1 / scale(c);
        const double* const from = x + c * node_count_ + unknown_of(j, k);
        double* const to = field.component(c) + layout.index(0, j, k);
        for (std::int64_t i = 0; i < owned[0]; ++i) to[i] = factor * from[i];
      }
}

template <class F>
void Equilibrium::for_each_row(const lattice::Field<double>& u, F&& use) {
  const bool more = added_ != nullptr && !added_->empty();
  if (more) added_->update(u);
  kernel_.for_each_row(u, [&](std::int64_t j, std::int64_t k, double* const* force) {
    if (more) added_->add(j, k, force);
    use(j, k, force);
  });
}

template <class F>
void Equilibrium::forces(const lattice::Field<double>& u, double* b, F&& add_loads) {
  const std::int64_t count = model_.layout().owned()[0];
  for_each_row(u, [&](std::int64_t j, std::int64_t k, double* const* force) {
    add_loads(j, k, force);
    for (int c = 0; c < components_; ++c) {
      double* const to = b + c * node_count_ + unknown_of(j, k);
      for (std::int64_t i = 0; i < count; ++i) to[i] = force[c][i] / scale(c);
    }
  });
}

void Equilibrium::right_hand_side(double* b, const mechanics::Tensor6& mean_strain) {
  work_.zero();
  for (const Prescribed& p : prescribed_) work_.component(p.component)[p.node] = p.value;
  model_.lattice.halo->exchange(work_);
  mechanics::add_uniform_strain(model_, mean_strain, work_);
  mechanics::LoadRows loads(model_);
  loads.set_time(t_);
  forces(work_, b, [&](std::int64_t j, std::int64_t k, double* const* force) { loads.add(j, k, force); });
  for (const Prescribed& p : prescribed_) b[p.unknown] = 0;
}

void Equilibrium::right_hand_side(const lattice::Field<double>& u, double* b) {
  forces(u, b, [](std::int64_t, std::int64_t, double* const*) {});
  for (const Prescribed& p : prescribed_) b[p.unknown] = 0;
}

void Equilibrium::apply(const double* x, double* y) {
  to_field(x, work_);
  for (const Prescribed& p : prescribed_) work_.component(p.component)[p.node] = 0;
  model_.lattice.halo->exchange(work_);
  const std::int64_t count = model_.layout().owned()[0];
  for_each_row(work_, [&](std::int64_t j, std::int64_t k, double* const* force) {
    for (int c = 0; c < components_; ++c) {
      const double factor = -1 / scale(c);
      double* const to = y + c * node_count_ + unknown_of(j, k);
      for (std::int64_t i = 0; i < count; ++i) to[i] = factor * force[c][i];
    }
  });
  for (const Prescribed& p : prescribed_) y[p.unknown] = x[p.unknown];
}

void Equilibrium::gather(const lattice::Field<double>& displacement, double* x) const {
  const lattice::Layout& layout = model_.layout();
  const Int3& owned = layout.owned();
  for (std::int64_t k = 0; k < owned[2]; ++k)
    for (std::int64_t j = 0; j < owned[1]; ++j)
      for (int c = 0; c < components_; ++c) {
        const double* const from = displacement.component(c) + layout.index(0, j, k);
        double* const to = x + c * node_count_ + unknown_of(j, k);
        for (std::int64_t i = 0; i < owned[0]; ++i) to[i] = scale(c) * from[i];
      }
  for (const Prescribed& p : prescribed_) x[p.unknown] = 0;
}

void Equilibrium::fill(const double* x, lattice::Field<double>& displacement) const {
  displacement.zero();
  to_field(x, displacement);
  const double* const mass = model_.inertia.component(0);
  lattice::for_each_owned(model_.layout(), [&](auto, auto, auto, auto n) {
    if (mass[n] > 0) return;
    for (int c = 0; c < components_; ++c) displacement.component(c)[n] = 0;
  });
  for (const Prescribed& p : prescribed_) displacement.component(p.component)[p.node] = p.value;
}

}  // namespace koshi::statics
