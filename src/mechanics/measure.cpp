#include "mechanics/measure.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "base/exact_sum.h"
#include "lattice/halo.h"
#include "mechanics/cell_stress.h"
#include "mechanics/percentile.h"
#include "mechanics/uniform_strain.h"

namespace koshi::mechanics {

using Quantity = model::ProbeDefinition::Quantity;
using Reduce = model::ProbeDefinition::Reduce;

Meter::Meter(const model::Model& model, ForceKernel& kernel)
    : model_(model),
      kernel_(kernel),
      loads_(model),
      motion_rows_(model.layout(), model.motions, [](const model::PrescribedMotion& m) { return m.node; }) {
  std::vector<std::int64_t> cells;
  bool any = false;
  for (const model::Probe& probe : model.probes)
    for (const model::SurfacePlace& place : probe.places) {
      if (cells.empty() || cells.back() != place.cell) cells.push_back(place.cell);
      any = true;
    }
  if (model.communicator.any(any)) surface_.emplace(model.lattice, cells);
}

namespace {

// Forces on a row of nodes, component by component.
struct ForceRow {
  double* const* springs;
  double* const* loads;
  std::array<const double*, 6> faces{};  // of cracks; null: none

  double of_faces(int c, std::int64_t i) const { return faces[c] != nullptr ? faces[c][i] : 0; }
  double total(int c, std::int64_t i) const { return springs[c][i] + loads[c][i] + of_faces(c, i); }
};

}  // namespace

template <class F>
void Meter::for_each_row(model::State& state, F&& f) {
  const lattice::Layout& layout = model_.layout();
  exchange_displacements(model_, state.mean_strain, state.displacement);
  loads_.set_time(state.time);
  std::array<std::vector<double>, 6> external;
  std::array<double*, 6> external_row{};
  for (int c = 0; c < 6; ++c) external[c].resize(static_cast<std::size_t>(layout.owned()[0]));
  for (int c = 0; c < 6; ++c) external_row[c] = external[c].data();
  kernel_.for_each_row(state.displacement, [&](std::int64_t j, std::int64_t k, double* const* internal) {
    for (auto& e : external) std::fill(e.begin(), e.end(), 0);
    loads_.add(j, k, external_row.data());
    ForceRow row{internal, external_row.data()};
    for (int c = 0; c < state.face_force.components(); ++c)
      row.faces[c] = state.face_force.component(c) + layout.index(0, j, k);
    f(j, k, row);
  });
}

double* const* Meter::ground_row(std::int64_t j, std::int64_t k) {
  if (kernel_.ground().empty()) return nullptr;
  for (std::size_t c = 0; c < 3; ++c) {
    ground_[c].assign(static_cast<std::size_t>(model_.layout().owned()[0]), 0);
    ground_row_[c] = ground_[c].data();
  }
  kernel_.ground().add(j, k, ground_row_.data());
  return ground_row_.data();
}

namespace {

// Marks the prescribed components of a row, by node.
class RowMask {
 public:
  RowMask(const model::Model& model, const RowIndex& rows)
      : model_(model), rows_(rows), mask_(static_cast<std::size_t>(model.layout().owned()[0])) {}
  const std::vector<std::uint8_t>& of(std::int64_t j, std::int64_t k) {
    std::fill(mask_.begin(), mask_.end(), 0);
    const std::int64_t row = j + model_.layout().owned()[1] * k, first = model_.layout().index(0, j, k);
    for (std::size_t m = rows_.begin(row); m < rows_.end(row); ++m)
      mask_[static_cast<std::size_t>(model_.motions[m].node - first)] |=
          static_cast<std::uint8_t>(1 << model_.motions[m].component);
    return mask_;
  }

 private:
  const model::Model& model_;
  const RowIndex& rows_;
  std::vector<std::uint8_t> mask_;
};

bool needs_reactions(const model::Probe& probe) {
  const Quantity quantity = probe.definition.quantity;
  return quantity == Quantity::reaction || quantity == Quantity::moment;
}

struct Sums {
  ExactSum elastic, kinetic, leapfrog, residual, reference, pending;

  Balance total(const Communicator& communicator) {
    for (ExactSum* s : {&elastic, &kinetic, &leapfrog, &residual, &reference, &pending}) s->sum_ranks(communicator);
    return {
        elastic.value(), kinetic.value(), leapfrog.value(), std::sqrt(residual.value()), std::sqrt(reference.value()),
        pending.value()};
  }
};

// Adds one row to the sums. A node's terms are added up in a fixed order, nodes without rounding, so that the result
// does not depend on the partition.
void add_row(const model::Model& model, const model::State& state, double dt, std::int64_t j, std::int64_t k,
             const ForceRow& forces, const std::vector<std::uint8_t>& mask, Sums& sums) {
  const int components = model.components();
  const std::int64_t n = model.layout().index(0, j, k);
  const double d = model.lattice.grid.d;
  const bool strained = state.mean_strain != Tensor6{};
  for (std::int64_t i = 0; i < model.layout().owned()[0]; ++i) {
    if (model.inertia.component(0)[n + i] == 0) continue;
    double elastic = 0, kinetic = 0, leapfrog = 0, residual = 0, reference = 0, pending = 0;
    // The mean strain's part of the energy is the mean stress's, see add_mean_strain().
    Vec3 uniform{};
    if (strained) uniform = uniform_displacement(model, state.mean_strain, model.layout().global({i, j, k}));
    for (int c = 0; c < components; ++c) {
      const double force = forces.total(c, i);
      const double inertia = model.inertia.component(c < 3 ? 0 : 1)[n + i];
      const double lever = c < 3 ? 1 : d;
      const bool prescribed = mask[static_cast<std::size_t>(i)] >> c & 1;
      const double gain = prescribed ? 0 : 0.5 * dt * force / inertia;
      const double v = state.velocity.component(c)[n + i] + gain;
      const double u = state.displacement.component(c)[n + i] - (c < 3 ? uniform[static_cast<std::size_t>(c)] : 0);
      elastic -= 0.5 * u * forces.springs[c][i];
      kinetic += 0.5 * inertia * v * v;
      leapfrog += 0.5 * inertia * (v - gain) * (v + gain);
      // The half step from the middle of the last one to the displacements: loads' work, and supports' against springs.
      const double springs = forces.springs[c][i] + forces.of_faces(c, i);
      pending += 0.5 * dt * (v - gain) * (prescribed ? -springs : forces.loads[c][i]);
      const double square = force * force / (lever * lever);
      (prescribed ? reference : residual) += square;
      reference += forces.loads[c][i] * forces.loads[c][i] / (lever * lever);
    }
    sums.elastic += elastic;
    sums.kinetic += kinetic;
    sums.leapfrog += elastic + leapfrog;
    sums.residual += residual;
    sums.reference += reference;
    sums.pending += pending;
  }
}

// A periodic body under a mean strain E and mean stress S: the energy of its springs is that of the periodic part of
// the displacements and V E : S / 2. Forces are compared with those of S on the faces of the box, as if it was cut out.
void add_mean_strain(const model::Model& model, const MeanState& mean, Balance& balance) {
  const lattice::Grid& grid = model.lattice.grid;
  double work = 0;
  for (std::size_t c = 0; c < 6; ++c) work += (c < 3 ? 1 : 2) * mean.strain[c] * mean.stress[c];
  const double cell = grid.d * grid.d * grid.d;
  const double energy = 0.5 * cell * static_cast<double>(grid.cell_count()) * work;
  balance.elastic_energy += energy;
  balance.leapfrog_energy += energy;
  const auto& [xx, yy, zz, yz, xz, xy] = mean.stress;
  const std::array<Vec3, 3> tractions{Vec3{xx, xy, xz}, Vec3{xy, yy, yz}, Vec3{xz, yz, zz}};
  double square = balance.reference * balance.reference;
  for (std::size_t a = 0; a < 3; ++a) {
    if (!grid.periodic[a]) continue;
    const double nodes = 2 * static_cast<double>(grid.cell_count() / grid.cells[a]);
    square += nodes * std::pow(grid.d, 4) * dot(tractions[a], tractions[a]);
  }
  balance.reference = std::sqrt(square);
}

}  // namespace

Balance Meter::balance(model::State& state, double dt) {
  Sums sums;
  RowMask mask(model_, motion_rows_);
  for_each_row(state, [&](auto j, auto k, const ForceRow& forces) {
    add_row(model_, state, dt, j, k, forces, mask.of(j, k), sums);
  });
  Balance balance = sums.total(model_.communicator);
  if (model_.definition.macroscopic)
    add_mean_strain(model_, {state.mean_strain, mean_stress(model_, state.displacement)}, balance);
  return balance;
}

lattice::Field<double> Meter::reactions(model::State& state, bool ground) {
  lattice::Field<double> reaction(model_.layout(), model_.components());
  for_each_row(state, [&](auto j, auto k, const ForceRow& forces) {
    const std::int64_t row = j + model_.layout().owned()[1] * k, first = model_.layout().index(0, j, k);
    if (double* const* held = ground ? ground_row(j, k) : nullptr)
      for (int c = 0; c < 3; ++c) std::copy_n(held[c], model_.layout().owned()[0], reaction.component(c) + first);
    for (std::size_t m = motion_rows_.begin(row); m < motion_rows_.end(row); ++m) {
      const auto& [node, component, is_velocity, value, boundary] = model_.motions[m];
      reaction.component(component)[node] -= forces.total(component, node - first);
    }
  });
  return reaction;
}

Measurement Meter::measure(model::State& state, double dt) {
  // Reactions are only kept at nodes of probes that ask for them.
  std::unordered_map<std::int64_t, std::array<double, 6>> wanted;
  for (const model::Probe& probe : model_.probes)
    if (needs_reactions(probe))
      for (const auto& [node, weight] : probe.nodes) wanted[node] = {};

  Sums sums;
  RowMask mask(model_, motion_rows_);
  for_each_row(state, [&](auto j, auto k, const ForceRow& forces) {
    const auto& prescribed = mask.of(j, k);
    add_row(model_, state, dt, j, k, forces, prescribed, sums);
    const std::int64_t row = j + model_.layout().owned()[1] * k, first = model_.layout().index(0, j, k);
    for (std::size_t m = motion_rows_.begin(row); m < motion_rows_.end(row); ++m) {
      const model::PrescribedMotion& motion = model_.motions[m];
      const auto at = wanted.find(motion.node);
      if (at == wanted.end()) continue;
      const int c = motion.component;
      at->second[static_cast<std::size_t>(c)] = -forces.total(c, motion.node - first);
    }
    double* const* held = wanted.empty() ? nullptr : ground_row(j, k);
    for (std::int64_t i = 0; held != nullptr && i < model_.layout().owned()[0]; ++i)
      if (const auto at = wanted.find(first + i); at != wanted.end())
        for (std::size_t c = 0; c < 3; ++c) at->second[c] += held[c][i];
  });

  Measurement result{sums.total(model_.communicator), {}};
  if (model_.definition.macroscopic) {
    result.mean = {state.mean_strain, mean_stress(model_, state.displacement)};
    add_mean_strain(model_, *result.mean, result.balance);
  }
  if (surface_) surface_->update(state.displacement);
  for (const model::Probe& probe : model_.probes) {
    std::vector<std::array<double, 6>> reactions;
    if (needs_reactions(probe))
      for (const auto& [node, weight] : probe.nodes) reactions.push_back(wanted[node]);
    result.probes.push_back(probe_value(probe, state, reactions));
  }
  return result;
}

ProbeValue Meter::probe_value(const model::Probe& probe, const model::State& state,
                              const std::vector<std::array<double, 6>>& node_reactions) const {
  const Quantity quantity = probe.definition.quantity;
  const bool tensor = quantity == Quantity::stress || quantity == Quantity::strain;
  const std::size_t components = tensor ? 6 : 3;
  std::vector<ExactSum> sum(components);
  ProbeValue largest(components, 0);
  std::vector<std::vector<Weighted>> all(components);  // for a percentile
  const bool ranked = probe.definition.reduce == Reduce::percentile;
  const auto take = [&](const std::array<double, 6>& value, double weight) {
    for (std::size_t c = 0; c < components; ++c) {
      sum[c] += weight * value[c];
      if (ranked) all[c].push_back({value[c], weight});
      if (std::abs(value[c]) > std::abs(largest[c])) largest[c] = value[c];
    }
  };
  for (const model::SurfacePlace& place : probe.places) {
    const SurfaceStress::Value at = surface_->at(place.cell, place.from_centre);
    take(quantity == Quantity::stress ? at.stress : at.strain, probe.definition.reduce == Reduce::sum ? 1 : place.area);
  }
  for (std::size_t p = 0; p < probe.nodes.size(); ++p) {
    const auto& [node, weight] = probe.nodes[p];
    std::array<double, 6> value{};
    if (tensor) {
      const CellState at = node_state(model_.lattice, state.displacement, node);
      value = quantity == Quantity::stress ? at.stress : at.strain;
    } else if (quantity == Quantity::rotation && model_.components() == 3) {
      const Vec3 w = node_state(model_.lattice, state.displacement, node).rotation;
      std::copy(w.begin(), w.end(), value.begin());
    } else if (quantity == Quantity::moment) {
      const auto& [fx, fy, fz, mx, my, mz] = node_reactions[p];
      const Vec3 moment = cross(probe.arms[p], {fx, fy, fz}) + Vec3{mx, my, mz};
      std::copy(moment.begin(), moment.end(), value.begin());
    } else {
      for (int c = 0; c < 3; ++c)
        value[static_cast<std::size_t>(c)] =
            quantity == Quantity::reaction   ? node_reactions[p][static_cast<std::size_t>(c)]
            : quantity == Quantity::rotation ? state.displacement.component(3 + c)[node]
            : quantity == Quantity::velocity ? state.velocity.component(c)[node]
                                             : state.displacement.component(c)[node];
    }
    take(value, weight);
  }

  ProbeValue result(components);
  for (std::size_t c = 0; c < components; ++c) {
    if (ranked) {
      result[c] = percentile(model_.communicator, all[c], probe.definition.percentile);
      continue;
    }
    if (probe.definition.reduce == Reduce::max) {
      // The value of largest magnitude, with its sign.
      const double up = model_.communicator.max(largest[c]), down = model_.communicator.min(largest[c]);
      result[c] = up >= -down ? up : down;
      continue;
    }
    sum[c].sum_ranks(model_.communicator);
    result[c] = sum[c].value() / (probe.definition.reduce == Reduce::sum ? 1 : probe.total);
  }
  return result;
}

std::string name_of(Quantity quantity) {
  constexpr std::array<const char*, 7> names{"displacement", "rotation", "velocity", "reaction",
                                             "moment",       "stress",   "strain"};
  return names[static_cast<std::size_t>(quantity)];
}

std::string unit_of(Quantity quantity) {
  constexpr std::array<const char*, 7> units{"m", "rad", "m/s", "N", "N m", "Pa", "1"};
  return units[static_cast<std::size_t>(quantity)];
}

std::vector<std::string> component_names(Quantity quantity) {
  if (quantity == Quantity::stress || quantity == Quantity::strain) return {"xx", "yy", "zz", "yz", "xz", "xy"};
  return {"x", "y", "z"};
}

}  // namespace koshi::mechanics
