#include "failure/crack_events.h"

#include <algorithm>
#include <limits>

#include "failure/joint_energy.h"
#include "lattice/halo.h"

namespace koshi::failure {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();
// Cells this close to the first one go with it: symmetric ones differ by the solver's tolerance.
constexpr double tie = 1e-3;
// An event takes this of a cell's stress, over the strength at the onset, but no more than half of its stiffness.
constexpr double tooth = 0.15;
// A cell with less than this of its strength left breaks.
constexpr double least_strength = 4e-3;

}  // namespace

CrackEvents::CrackEvents(Cracking& cracking, model::Model& model, model::State& state)
    : cracking_(cracking), model_(model), state_(state), faces_(cracking, model, state), load_(state.displacement) {
  state_.face_force.zero();
  for (const std::int64_t n : cracking_.cracked_) cracking_.weaken(n, cracking_.load(n).damage);
}

// Energy that damage takes from a cell between two events, less what its closed faces take over, for each unit of the
// factor at the second [J/m^3].
double CrackEvents::gain(const Loss& loss) const {
  const mechanics::CellMotion now = mechanics::cell_motion(model_.lattice, state_.displacement, loss.cell);
  const double springs = joint_energy(model_.lattice, loss.cell, loss.motion, now);
  const double faces = 0.5 * cracking_.law(loss.cell).youngs_modulus() * loss.pressed * faces_.pressed(loss.cell);
  return loss.damage * (springs - faces);
}

void CrackEvents::consider(std::int64_t n, double factor) {
  if (!(factor <= least_ * (1 + tie))) return;
  least_ = std::min(least_, factor);
  candidates_.push_back({n, factor});
}

void CrackEvents::consider_row(std::int64_t j, std::int64_t k) {
  const lattice::Layout& layout = model_.layout();
  const std::int64_t cells = layout.owned()[0] + 1, first = layout.index(-1, j, k);
  cracking_.look_at_row(j, k);
  const std::uint16_t* material = model_.lattice.cell.component(0) + first;
  const float* safe = cracking_.limit_.component(0) + first;
  for (std::int64_t i = 0; i < cells; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const double bound = cracking_.bounds_[material[i]](cracking_.mean_[at], cracking_.radius_[at]);
    if (safe[i] == never) continue;
    largest_ = std::max(largest_, cracking_.radius_[at]);
    if (!(bound > 0) || !(safe[i] <= least_ * (1 + tie) * bound)) continue;
    const std::int64_t n = first + i;
    const Tensor6 strain = mechanics::cell_strain(model_.lattice, state_.displacement, n);
    const Crack crack = cracking_.law(n).ahead(strain, model_.strength_of(n), cracking_.tracks_.lead(n));
    if (crack.kappa > 0) consider(n, cracking_.tracks_.hold(n, crack) * crack.limit / crack.kappa);
  }
}

// Where a cracked cell is at its strength. A cell of the last event takes more energy on the way there.
double CrackEvents::factor_of_cracked(std::int64_t n) const {
  const Crack crack = cracking_.load(n);
  const CellLaw& law = cracking_.law(n);
  const auto loss = std::ranges::lower_bound(losses_, n, {}, &Loss::cell);
  const bool lost = loss != losses_.end() && loss->cell == n;
  const double equivalent =
      crack.damage >= 1 ? 0 : law.equivalent(mechanics::cell_strain(model_.lattice, state_.displacement, n));
  return law.softening(crack).reach(crack.taken, lost ? std::max(loss->gain, 0.0) / crack.onset : 0,
                                    (1 - crack.damage) * equivalent / crack.limit);
}

double CrackEvents::next() {
  for (Loss& loss : losses_) loss.gain = gain(loss);
  candidates_.clear();
  least_ = never;
  largest_ = 0;
  for (const std::int64_t n : cracking_.cracked_) consider(n, factor_of_cracked(n));
  const Int3& owned = model_.layout().owned();
  for (std::int64_t k = -1; k < owned[2]; ++k)
    for (std::int64_t j = -1; j < owned[1]; ++j)
      if (cracking_.breakable_[cell_row(model_.layout(), j, k)] != 0) consider_row(j, k);
  least_ = model_.communicator.min(least_);
  // Tension that is only rounding of a body under pressure would ask for more.
  if (least_ * model_.communicator.max(largest_) > 1) least_ = never;
  return least_;
}

void CrackEvents::go(double factor) {
  const double d = model_.lattice.grid.d;
  for (const Loss& loss : losses_) {
    Crack crack = cracking_.load(loss.cell);
    crack.taken = std::min(crack.taken + factor * std::max(loss.gain, 0.0) / crack.onset, crack.ratio);
    cracking_.store(loss.cell, crack);
    // The whole loss, with its sign, so that the balance of energy closes.
    state_.crack.component(Cracking::dissipated)[loss.cell] +=
        factor * loss.gain * static_cast<double>(cracking_.whole_.component(0)[loss.cell]) * d * d * d;
  }
  losses_.clear();
  load_.go(factor);
  faces_.springs().update(state_.displacement);
}

bool CrackEvents::soften() {
  std::erase_if(candidates_, [this](const Candidate& c) { return !(c.factor <= least_ * (1 + tie)); });
  // In the order of cells in memory, by whatever way they were found.
  std::ranges::sort(candidates_, {}, &Candidate::cell);
  cracking_.begun_.clear();
  faces_.note();
  for (const Candidate& candidate : candidates_) soften(candidate.cell);
  cracking_.take_begun();
  std::sort(cracking_.cracked_.begin(), cracking_.cracked_.end());
  faces_.restore();
  return model_.communicator.any(!losses_.empty());
}

void CrackEvents::soften(std::int64_t n) {
  Crack crack = cracking_.load(n);
  if (crack.damage >= 1) return;  // its energy has come to its end
  const Tensor6 strain = mechanics::cell_strain(model_.lattice, state_.displacement, n);
  const bool fresh = crack.kappa == 0;
  if (fresh) {
    crack = cracking_.law(n).ahead(strain, model_.strength_of(n), cracking_.tracks_.lead(n));
    crack.offset = cracking_.tracks_.offset(n, crack);
  }
  const double equivalent = cracking_.law(n).equivalent(strain);
  crack.kappa = std::max(crack.kappa, equivalent);

  const double before = 1 - crack.damage, left = before * equivalent / crack.limit;
  double after = std::max(0.5, 1 - tooth / left) * before;
  if (crack.ratio <= 1 || left < least_strength || after < Cracking::trace) after = 0;
  crack.damage = 1 - after;
  cracking_.store(n, crack);
  if (1 - before < model::parted && crack.damage >= model::parted)
    state_.crack.component(Cracking::moment)[n] = state_.time;
  cracking_.weaken(n, crack.damage);
  losses_.push_back({n, before - std::max(after, Cracking::trace),
                     mechanics::cell_motion(model_.lattice, state_.displacement, n),
                     std::min(along(strain, crack.normal), 0.0)});
  if (!fresh) return;
  cracking_.begun_.push_back(n);
  faces_.note(n);
}

}  // namespace koshi::failure
