#include "mechanics/corner_forces.h"

#include <algorithm>

#include "mechanics/corners.h"

namespace koshi::mechanics {

void mark_rows(const lattice::Layout& layout, std::int64_t cell, std::vector<char>& rows) {
  const Int3 at = layout.place(cell), &owned = layout.owned();
  for (int row = 0; row < 4; ++row) {
    const std::int64_t j = at[1] + (row & 1), k = at[2] + (row >> 1);
    if (j < 0 || k < 0 || j >= owned[1] || k >= owned[2]) continue;
    rows[static_cast<std::size_t>(j + owned[1] * k)] = 1;
  }
}

CornerForces::CornerForces(const lattice::Layout& layout, lattice::Field<double>& force)
    : layout_(layout), force_(force), rows_(static_cast<std::size_t>(layout.owned()[1] * layout.owned()[2]), 0) {}

void CornerForces::forget() { std::ranges::fill(rows_, 0); }

void CornerForces::clear(std::int64_t cell) {
  for (int a = 0; a < corner_count; ++a)
    for (int c = 0; c < force_.components(); ++c) force_.component(c)[cell + layout_.offset(corner(a))] = 0;
}

void CornerForces::add(std::int64_t j, std::int64_t k, double* const* force) const {
  if (rows_[static_cast<std::size_t>(j + layout_.owned()[1] * k)] == 0) return;
  const std::int64_t n = layout_.index(0, j, k);
  for (int c = 0; c < force_.components(); ++c)
    for (std::int64_t i = 0; i < layout_.owned()[0]; ++i) force[c][i] += force_.component(c)[n + i];
}

}  // namespace koshi::mechanics
