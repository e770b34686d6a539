#include "failure/closed_faces.h"

#include <algorithm>
#include <utility>

#include "base/exact_sum.h"

namespace koshi::failure {
namespace {

// Strains this much smaller than the largest pressing one are those of the solver's tolerance, and change nothing.
constexpr double still = 1e-6;
// Levels that take a closed cell for one with less than this of its stiffness are worth being made anew.
constexpr double soft = 0.1;

}  // namespace

ClosedFaces::ClosedFaces(const Cracking& cracking, model::Model& model, model::State& state)
    : cracking_(cracking), model_(model), state_(state), springs_(model.lattice, state.face_force) {}

mechanics::FaceSpring ClosedFaces::spring(std::int64_t n) const {
  const Crack crack = cracking_.load(n);
  return {n, crack.normal, cracking_.share(n, crack) * cracking_.law(n).youngs_modulus()};
}

bool ClosedFaces::is_closed(std::int64_t n) const {
  const auto& springs = springs_.springs();
  const auto at = std::ranges::lower_bound(springs, n, {}, &mechanics::FaceSpring::cell);
  return at != springs.end() && at->cell == n;
}

bool ClosedFaces::is_owned(std::int64_t n) const { return model_.layout().owns(model_.layout().place(n)); }

double ClosedFaces::pressed(std::int64_t cell) const {
  if (!is_closed(cell)) return 0;
  return mechanics::strain_along(model_.lattice, state_.displacement, cell, cracking_.load(cell).normal);
}

bool ClosedFaces::look() {
  std::vector<double> strains;
  double most = 0;
  for (const std::int64_t n : cracking_.cracked_) {
    strains.push_back(mechanics::strain_along(model_.lattice, state_.displacement, n, cracking_.load(n).normal));
    most = std::max(most, -strains.back());
  }
  most = model_.communicator.max(most);
  std::vector<mechanics::FaceSpring> closed;
  bool changed = false;
  for (std::size_t c = 0; c < strains.size(); ++c) {
    const std::int64_t n = cracking_.cracked_[c];
    const bool before = is_closed(n), now = strains[c] < (before ? still : -still) * most;
    if (now) closed.push_back(spring(n));
    changed = changed || now != before;
  }
  changed = model_.communicator.any(changed);
  if (changed) springs_.set(std::move(closed));
  return changed;
}

void ClosedFaces::restore() {
  std::vector<mechanics::FaceSpring> closed;
  for (const mechanics::FaceSpring& before : springs_.springs()) closed.push_back(spring(before.cell));
  springs_.set(std::move(closed));
}

double ClosedFaces::energy() const {
  const double d = model_.lattice.grid.d;
  ExactSum sum;
  for (const mechanics::FaceSpring& spring : springs_.springs()) {
    if (!is_owned(spring.cell)) continue;
    const double strain = mechanics::strain_along(model_.lattice, state_.displacement, spring.cell, spring.normal);
    sum += 0.5 * d * d * d * spring.stiffness * strain * strain;
  }
  sum.sum_ranks(model_.communicator);
  return sum.value();
}

void ClosedFaces::note() {
  noted_.clear();
  for (const std::int64_t n : cracking_.cracked_) {
    if (!is_owned(n)) continue;
    const mechanics::FaceSpring of = spring(n);
    noted_.push_back({n, mechanics::strain_along(model_.lattice, state_.displacement, n, of.normal), of.stiffness});
  }
}

void ClosedFaces::note(std::int64_t fresh) {
  note(fresh, mechanics::strain_along(model_.lattice, state_.displacement, fresh, cracking_.load(fresh).normal));
}

void ClosedFaces::note(std::int64_t fresh, double strain) {
  if (is_owned(fresh)) noted_.push_back({fresh, strain, 0});
}

// A spring of stiffness E' that opens on the way from strain e < 0 to e' > 0 gives back E' e^2/2; half the sum of its
// stresses times the way is -E' e (e' - e)/2, of which E' e e'/2 is too much. One that closes likewise.
double ClosedFaces::bend() const {
  const double d = model_.lattice.grid.d;
  ExactSum sum;
  for (const Noted& noted : noted_) {
    const mechanics::FaceSpring of = spring(noted.cell);
    const double strain = mechanics::strain_along(model_.lattice, state_.displacement, noted.cell, of.normal);
    const double stiffness = noted.strain < 0 ? -noted.stiffness : of.stiffness;
    if ((noted.strain < 0) != (strain < 0)) sum += 0.5 * d * d * d * stiffness * noted.strain * strain;
  }
  sum.sum_ranks(model_.communicator);
  return sum.value();
}

void ClosedFaces::make_levels(const std::function<void()>& make) {
  std::vector<float> factors;
  for (const mechanics::FaceSpring& spring : springs_.springs())
    factors.push_back(std::exchange(factor(spring.cell), cracking_.whole_.component(0)[spring.cell]));
  make();
  std::size_t next = 0;
  for (const mechanics::FaceSpring& spring : springs_.springs()) factor(spring.cell) = factors[next++];
  soft_.clear();
  for (const std::int64_t n : cracking_.cracked_)
    if (!is_closed(n) && factor(n) < soft * cracking_.whole_.component(0)[n]) soft_.push_back(n);
}

bool ClosedFaces::ask_for_levels() const {
  return model_.communicator.any(std::ranges::any_of(springs_.springs(), [this](const mechanics::FaceSpring& spring) {
    return std::ranges::binary_search(soft_, spring.cell);
  }));
}

}  // namespace koshi::failure
