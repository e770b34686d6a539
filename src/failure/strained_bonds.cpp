#include "failure/strained_bonds.h"

#include <algorithm>

namespace koshi::failure {

double StrainedBonds::look(double share) {
  const Int3& owned = model_.layout().owned();
  bonds_.clear();
  most_ = 0;
  for (std::int64_t k = 0; k < owned[2]; ++k)
    for (std::int64_t j = 0; j < owned[1]; ++j)
      if (breaking_.breakable_[static_cast<std::size_t>(j + owned[1] * k)] != 0) look_at_row(j, k, share);
  most_ = model_.communicator.max(most_);
  std::erase_if(bonds_, [&](const Bond& bond) { return bond.strained < share * most_; });
  return most_;
}

void StrainedBonds::look_at_row(std::int64_t j, std::int64_t k, double share) {
  breaking_.look_at_row(j, k);
  const std::int64_t first = model_.layout().index(0, j, k);
  for (std::int64_t i = 0; i < model_.layout().owned()[0]; ++i) {
    if (breaking_.bound(i) < share * most_) continue;
    for (int slot = 0; slot < lattice::slot_count; ++slot) {
      const auto [stretch, shear] = breaking_.strained(first + i, slot);
      const double most = std::max(stretch, shear);
      if (!(most > 0) || most < share * most_) continue;
      most_ = std::max(most_, most);
      bonds_.push_back({first + i, slot, shear > stretch, most});
    }
  }
}

void StrainedBonds::break_them(double at_least) {
  for (const Bond& bond : bonds_)
    if (bond.strained >= at_least) breaking_.break_bond(bond.node, bond.slot, bond.by_shear);
  bonds_.clear();
  breaking_.exchange();
  std::ranges::sort(breaking_.cracked_);
}

}  // namespace koshi::failure
