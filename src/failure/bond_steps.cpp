#include "failure/bond_steps.h"

#include <algorithm>

namespace koshi::failure {
namespace {

// Bonds strained to this part of the worst one, over what they stand, break with it.
constexpr double share = 0.99;

}  // namespace

BondSteps::BondSteps(BondBreaking& breaking, model::Model& model, model::State& state)
    : breaking_(breaking),
      state_(state),
      broken_(breaking, model, state),
      bonds_(breaking, model),
      bonds_before_(state.bonds) {
  broken_.note();
}

void BondSteps::begin() {
  const lattice::Field<double> last = broken_.before();
  broken_.note();
  for (std::size_t i = 0; i < last.count(); ++i)
    state_.displacement.data()[i] += state_.displacement.data()[i] - last.data()[i];
  bonds_before_ = state_.bonds;
}

double BondSteps::look() {
  fly_ = broken_.has_parted();
  return std::max(bonds_.look(share) - 1, 0.0);
}

void BondSteps::take() {
  bonds_.break_them(1);
  broken_.renew();
}

void BondSteps::end() {
  for (const std::int64_t n : breaking_.cracked_)
    if (breaking_.fresh(n) != 0) breaking_.break_in_cell(n, broken_.energy_lost(n));
  breaking_.make_lattice_follow();
}

void BondSteps::undo() {
  state_.bonds = bonds_before_;
  state_.displacement = broken_.before();
  std::erase_if(breaking_.cracked_, [this](std::int64_t n) {
    const bool whole = breaking_.broken_now(n) == 0;
    if (whole) state_.crack.component(Fracturing::kappa)[n] = 0;
    return whole;
  });
  broken_.renew();
  broken_.update();
}

}  // namespace koshi::failure
