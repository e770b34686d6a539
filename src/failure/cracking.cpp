#include "failure/cracking.h"

#include <algorithm>
#include <limits>

#include "lattice/halo.h"

namespace koshi::failure {
Cracking::Cracking(model::Model& model, model::State& state)
    : Fracturing(model, state),
      rows_(strain_rows()),
      limit_(model.layout(), 1),
      tracks_(model, state),
      reach_(model.lattice, state.velocity),
      carried_(model.layout()) {
  const lattice::Layout& layout = model.layout();
  if (model.lattice.factor.components() == 0) model::make_factors(model.lattice, [](const Int3&) { return 1.0F; });
  whole_ = model.lattice.factor;
  laws_.resize(1);
  bounds_.resize(1);
  per_strain_.resize(1, 1);
  for (const model::MaterialDefinition& material : model.definition.materials) {
    laws_.emplace_back();
    bounds_.emplace_back();
    per_strain_.push_back(1);
    if (!material.cracks()) continue;
    laws_.back().emplace(material.elastic, *material.fracture, model.lattice.grid.d);
    bounds_.back() = laws_.back()->bound();
    per_strain_.back() = 0.5 * model.lattice.grid.d / bounds_.back().slope();
  }

  const auto cells = static_cast<std::size_t>(layout.owned()[0] + 1);
  mean_.resize(cells);
  radius_.resize(cells);
  breakable_.resize(cell_row(layout, layout.owned()[1], layout.owned()[2]), 0);
  std::size_t breakable = 0;
  lattice::for_each(layout, {-1, -1, -1}, layout.owned(), [&](auto, auto j, auto k, auto n) {
    if (!laws_[model_.lattice.cell.component(0)[n]]) return;
    breakable_[cell_row(layout, j, k)] = 1;
    ++breakable;
  });
  reach_.keep(breakable_);
  cracked_.reserve(breakable);
  begun_.reserve(breakable);
  faces_.reserve(breakable);
  carried_.reserve(breakable);
  restore();
}

void Cracking::restore() {
  const lattice::Layout& layout = model_.layout();
  model_.lattice.halo->exchange(state_.crack);
  model_.lattice.halo->exchange(state_.displacement);
  look_again();
  cracked_.clear();
  lattice::for_each(layout, {-1, -1, -1}, layout.owned(), [&](auto, auto, auto, auto n) {
    limit_.component(0)[n] = std::numeric_limits<float>::infinity();
    // Cells without springs have none to lose.
    if (!laws_[model_.lattice.cell.component(0)[n]] || whole_.component(0)[n] == 0) return;
    const Crack crack = load(n);
    set_factor(n, crack);
    if (crack.kappa == 0) return;
    cracked_.push_back(n);
  });
  tracks_.restore();
  restore_faces();
}

// Of cells that have become whole again, too.
void Cracking::restore_tracks() {
  model_.lattice.halo->exchange(state_.crack);
  tracks_.restore();
}

Crack Cracking::load(std::int64_t n) const {
  const auto part = [&](int c) { return state_.crack.component(c)[n]; };
  Crack crack;
  crack.damage = part(damage);
  crack.kappa = part(kappa);
  crack.onset = part(onset);
  crack.limit = part(limit);
  crack.ratio = part(ratio);
  crack.taken = part(taken);
  crack.shear = part(shear) != 0;
  crack.offset = part(offset);
  crack.normal = {part(normal), part(normal + 1), part(normal + 2)};
  crack.slip = {part(slip), part(slip + 1), part(slip + 2)};
  return crack;
}

void Cracking::store(std::int64_t n, const Crack& crack) {
  state_.crack.component(damage)[n] = crack.damage;
  state_.crack.component(kappa)[n] = crack.kappa;
  state_.crack.component(onset)[n] = crack.onset;
  state_.crack.component(limit)[n] = crack.limit;
  state_.crack.component(ratio)[n] = crack.ratio;
  state_.crack.component(taken)[n] = crack.taken;
  state_.crack.component(shear)[n] = crack.shear ? 1 : 0;
  state_.crack.component(offset)[n] = crack.offset;
  for (int a = 0; a < 3; ++a) {
    state_.crack.component(normal + a)[n] = crack.normal[static_cast<std::size_t>(a)];
    state_.crack.component(slip + a)[n] = crack.slip[static_cast<std::size_t>(a)];
  }
}

float Cracking::factor(std::int64_t n, double of_damage) const {
  return static_cast<float>((1 - of_damage) * static_cast<double>(whole_.component(0)[n]));
}

void Cracking::set_factor(std::int64_t n, const Crack& crack) {
  model_.lattice.factor.component(0)[n] = factor(n, crack.damage);
  // Rows pass by cells that have cracked: each of them is looked at by itself.
  const double below =
      crack.kappa > 0 ? std::numeric_limits<double>::infinity() : margin * law(n).safe(model_.strength_of(n));
  limit_.component(0)[n] = static_cast<float>(below);
}

void Cracking::weaken(std::int64_t n, double of_damage) {
  model_.lattice.factor.component(0)[n] =
      static_cast<float>(std::max(1 - of_damage, trace) * static_cast<double>(whole_.component(0)[n]));
  limit_.component(0)[n] = std::numeric_limits<float>::infinity();
}

void Cracking::follow(double dt) {
  const Int3& owned = model_.layout().owned();
  reach_.spend(dt);
  begun_.clear();
  for (std::int64_t k = -1; k < owned[2]; ++k)
    for (std::int64_t j = -1; j < owned[1]; ++j)
      if (reach_.is_spent(cell_row(model_.layout(), j, k))) follow_row(j, k, dt);
  const std::size_t before = cracked_.size();
  take_begun();
  if (cracked_.size() != before) insert_faces(before);
  follow_faces(dt);
}

void Cracking::look_at_row(std::int64_t j, std::int64_t k) {
  const lattice::Layout& layout = model_.layout();
  const double* u = state_.displacement.component(0) + layout.index(-1, j, k);
  rows_.strain(
      {{u, u + layout.pitch(), u + layout.plane(), u + layout.plane() + layout.pitch()}, state_.displacement.stride()},
      0.25 / model_.lattice.grid.d, layout.owned()[0] + 1, mean_.data(), radius_.data());
}

void Cracking::follow_row(std::int64_t j, std::int64_t k, double dt) {
  const std::int64_t cells = model_.layout().owned()[0] + 1, first = model_.layout().index(-1, j, k);
  look_at_row(j, k);
  const std::uint16_t* material = model_.lattice.cell.component(0) + first;
  const float* below = limit_.component(0) + first;
  double reach = std::numeric_limits<double>::infinity();
  for (std::int64_t i = 0; i < cells; ++i) {
    const double bound = bounds_[material[i]](mean_[static_cast<std::size_t>(i)], radius_[static_cast<std::size_t>(i)]);
    const double lacking = below[i] - bound;
    reach = std::min(reach, lacking * per_strain_[material[i]]);
    if (lacking < 0) crack_further(first + i, dt);
  }
  reach_.set(cell_row(model_.layout(), j, k), reach);
}

// The energy [J/m^3] that the cell's springs, intact, would hold in the step that has just been made: u.K.u'/2 with the
// displacements before and after it. This is what central differences lose with the springs to the last bit of their
// energy (theory, section 12).
double Cracking::intact_energy(std::int64_t n, double dt) const {
  const mechanics::CellMotion now = mechanics::cell_motion(model_.lattice, state_.displacement, n);
  const mechanics::CellMotion rate = mechanics::cell_motion(model_.lattice, state_.velocity, n);
  const auto energy = [&](double to, double of_rate) {
    mechanics::CellMotion motion = now;
    for (std::size_t a = 0; a < 8; ++a) {
      motion.displacement[a] = to * now.displacement[a] + of_rate * rate.displacement[a];
      motion.rotation[a] = to * now.rotation[a] + of_rate * rate.rotation[a];
    }
    return mechanics::cell_state(model_.lattice, motion, n).energy;
  };
  return (energy(1, -0.5 * dt) - energy(0, 0.5 * dt)) / model_.lattice.factor_of(n);
}

// The crack that begins in a cell without one at this strain, or nothing.
std::optional<Crack> Cracking::begin(std::int64_t n, const Tensor6& strain) const {
  auto crack = law(n).onset(strain, model_.strength_of(n), tracks_.lead(n));
  if (!crack || crack->kappa <= tracks_.hold(n, *crack) * crack->limit) return std::nullopt;
  crack->offset = tracks_.offset(n, *crack);
  return crack;
}

void Cracking::crack_further(std::int64_t n, double dt) {
  const Tensor6 strain = mechanics::cell_strain(model_.lattice, state_.displacement, n);
  Crack crack = load(n);
  const bool fresh = crack.kappa == 0;
  if (fresh) {
    const auto found = begin(n, strain);
    if (!found) return;
    crack = *found;
  } else if (law(n).equivalent(strain) < crack.kappa) {
    return;  // it has been strained more
  }

  // Springs that are lost take their energy with them, but for what closed faces take over.
  const double d = model_.lattice.grid.d, before = crack.damage;
  const double energy = intact_energy(n, dt) - law(n).faces(crack, strain).energy;
  law(n).soften(crack, strain, energy);
  state_.crack.component(dissipated)[n] += (crack.damage - before) * energy * whole_.component(0)[n] * d * d * d;
  if (before < model::parted && crack.damage >= model::parted) state_.crack.component(moment)[n] = state_.time;
  store(n, crack);
  set_factor(n, crack);
  if (fresh) begun_.push_back(n);
}

// What begins in a step does not lead others in the same step, so that the order of cells does not matter.
void Cracking::take_begun() {
  cracked_.insert(cracked_.end(), begun_.begin(), begun_.end());
  tracks_.follow(begun_);
}

}  // namespace koshi::failure
