#include "failure/crack_steps.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/exact_sum.h"
#include "failure/joint_energy.h"

namespace koshi::failure {
namespace {

// Changes of damage are made no larger than this many times, since they may go on otherwise than the last two did.
constexpr double most_stretch = 4;

}  // namespace

CrackSteps::CrackSteps(Cracking& cracking, model::Model& model, model::State& state)
    : cracking_(cracking), model_(model), state_(state), faces_(cracking, model, state), start_(state.displacement) {
  state_.face_force.zero();
  for (const std::int64_t n : cracking_.cracked_) cracking_.weaken(n, cracking_.load(n).damage);
}

void CrackSteps::begin() {
  faces_.note();
  for (std::size_t i = 0; i < start_.count(); ++i) {
    const double before = std::exchange(start_.data()[i], state_.displacement.data()[i]);
    state_.displacement.data()[i] += state_.displacement.data()[i] - before;
  }
  followed_.clear();
  stretch_ = 1;
  for (const std::int64_t n : cracking_.cracked_) followed_.push_back({n, cracking_.load(n)});
}

double CrackSteps::strain_before(std::int64_t n, const Vec3& normal) const {
  return mechanics::strain_along(model_.lattice, start_, n, normal);
}

// Energy that damage takes from the whole cell on the way through the step, less what its closed faces take over
// [J/m^3].
double CrackSteps::energy_lost(const Followed& cell, const Tensor6& strain, const Vec3& normal) const {
  const double springs =
      joint_energy(model_.lattice, cell.cell, mechanics::cell_motion(model_.lattice, start_, cell.cell),
                   mechanics::cell_motion(model_.lattice, state_.displacement, cell.cell));
  const double pressed = std::min(along(strain, normal), 0.0) * std::min(strain_before(cell.cell, normal), 0.0);
  return springs - 0.5 * cracking_.law(cell.cell).youngs_modulus() * pressed;
}

void CrackSteps::look(Followed& cell) {
  const CellLaw& law = cracking_.law(cell.cell);
  const Tensor6 strain = mechanics::cell_strain(model_.lattice, state_.displacement, cell.cell);
  const double damage = cracking_.load(cell.cell).damage;
  if (damage >= 1) fly_ = fly_ || along(strain, cracking_.load(cell.cell).normal) > 1;
  cell.next = cell.before;
  if (cell.before.damage >= 1) return;
  // A cell that began to crack in this step begins anew at each look, or not, but where it did.
  if (cell.before.kappa == 0) {
    const Crack begun = cracking_.load(cell.cell);
    cell.next = (begun.kappa > 0 ? law.onset(strain, model_.strength_of(cell.cell), begun.normal)
                                 : cracking_.begin(cell.cell, strain))
                    .value_or(Crack{});
    if (begun.kappa > 0) cell.next.offset = begun.offset;
  }
  if (cell.next.kappa > 0) law.soften(cell.next, strain, std::max(energy_lost(cell, strain, cell.next.normal), 0.0));
  const double limit = std::max(cell.next.limit, law.safe(model_.strength_of(cell.cell)));
  cell.off_before = cell.off;
  cell.off = (cell.next.damage - damage) * law.equivalent(strain) / limit;
}

// Cells of a row of cells that have no crack so far and are beyond their strength.
void CrackSteps::seek(std::int64_t j, std::int64_t k) {
  const std::int64_t cells = model_.layout().owned()[0] + 1, first = model_.layout().index(-1, j, k);
  cracking_.look_at_row(j, k);
  const std::uint16_t* material = model_.lattice.cell.component(0) + first;
  const float* below = cracking_.limit_.component(0) + first;
  for (std::int64_t i = 0; i < cells; ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (!(cracking_.bounds_[material[i]](cracking_.mean_[at], cracking_.radius_[at]) > below[i])) continue;
    const Tensor6 strain = mechanics::cell_strain(model_.lattice, state_.displacement, first + i);
    if (cracking_.begin(first + i, strain)) followed_.push_back({first + i, {}});
  }
}

double CrackSteps::look() {
  fly_ = false;
  const Int3& owned = model_.layout().owned();
  for (std::int64_t k = -1; k < owned[2]; ++k)
    for (std::int64_t j = -1; j < owned[1]; ++j)
      if (cracking_.breakable_[cell_row(model_.layout(), j, k)] != 0) seek(j, k);
  std::ranges::sort(followed_, {}, &Followed::cell);
  double off = 0;
  for (Followed& cell : followed_) {
    look(cell);
    off = std::max(off, std::abs(cell.off));
    // Rows pass by what is followed.
    cracking_.limit_.component(0)[cell.cell] = std::numeric_limits<float>::infinity();
  }
  fly_ = model_.communicator.any(fly_);
  stretch();
  return model_.communicator.max(off);
}

// Looks ask for ever the same part of what is missing: Aitken's factor on it, from the last two looks.
void CrackSteps::stretch() {
  ExactSum across, size;
  for (const Followed& cell : followed_) {
    if (!faces_.is_owned(cell.cell)) continue;
    const double change = cell.off - cell.off_before;
    across += cell.off_before * change;
    size += change * change;
  }
  for (ExactSum* sum : {&across, &size}) sum->sum_ranks(model_.communicator);
  const bool follows = std::ranges::any_of(followed_, [](const Followed& cell) { return cell.off_before != 0; });
  if (model_.communicator.any(follows) && size.value() > 0)
    stretch_ = std::clamp(-stretch_ * across.value() / size.value(), 1.0, most_stretch);
}

void CrackSteps::take() {
  cracking_.cracked_.clear();
  cracking_.begun_.clear();
  for (Followed& cell : followed_) {
    const double now = 1 - cracking_.load(cell.cell).damage, left = 1 - cell.next.damage;
    if (left > 0 && now > 0) cell.next.damage = std::max(cell.before.damage, 1 - now * std::pow(left / now, stretch_));
    cracking_.store(cell.cell, cell.next);
    cracking_.weaken(cell.cell, cell.next.damage);
    if (cell.next.kappa == 0) continue;
    cracking_.cracked_.push_back(cell.cell);
    if (cell.before.kappa == 0) cracking_.begun_.push_back(cell.cell);
  }
  cracking_.tracks_.follow(cracking_.begun_);
  faces_.restore();
}

void CrackSteps::end() {
  const double d = model_.lattice.grid.d;
  for (const Followed& cell : followed_) {
    const std::int64_t n = cell.cell;
    Crack crack = cracking_.load(n);
    if (crack.kappa == 0) {
      cracking_.set_factor(n, crack);  // whole again, and to be looked at
      continue;
    }
    const Tensor6 strain = mechanics::cell_strain(model_.lattice, state_.displacement, n);
    const double energy = energy_lost(cell, strain, crack.normal);
    const double lost = std::max(1 - cell.before.damage, Cracking::trace) - std::max(1 - crack.damage, Cracking::trace);
    crack.taken = std::min(cell.before.taken + lost * std::max(energy, 0.0) / crack.onset, crack.ratio);
    cracking_.store(n, crack);
    // The whole loss, with its sign, so that the balance of energy closes.
    state_.crack.component(Cracking::dissipated)[n] +=
        lost * energy * static_cast<double>(cracking_.whole_.component(0)[n]) * d * d * d;
    if (cell.before.damage < model::parted && crack.damage >= model::parted)
      state_.crack.component(Cracking::moment)[n] = state_.time;
    if (cell.before.kappa == 0) faces_.note(n, strain_before(n, crack.normal));
  }
  cracking_.restore_tracks();
}

void CrackSteps::undo() {
  std::copy_n(start_.data(), start_.count(), state_.displacement.data());
  for (Followed& cell : followed_) cell.next = cell.before;
  take();
  cracking_.restore_tracks();
  faces_.springs().update(state_.displacement);
}

}  // namespace koshi::failure
