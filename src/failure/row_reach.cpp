#include "failure/row_reach.h"

#include <algorithm>

namespace koshi::failure {

RowReach::RowReach(const model::SpringLattice& lattice, const lattice::Field<double>& velocity)
    : lattice_(lattice),
      velocity_(velocity),
      whole_(lattice.layout.owned()[0] == lattice.grid.nodes()[0] && !lattice.grid.periodic[0]) {}

void RowReach::keep(const std::vector<char>& rows) {
  const Int3& owned = lattice_.layout.owned();
  const std::size_t nodes = node_row(owned[1], owned[2]) + 1;
  kept_ = rows;
  reach_.assign(rows.size(), 0);
  range_.assign(nodes, {});
  noted_.assign(nodes, 0);
  wanted_.assign(nodes, 0);
  for (std::int64_t k = -1; k < owned[2]; ++k)
    for (std::int64_t j = -1; j < owned[1]; ++j)
      if (kept_[cell_row(lattice_.layout, j, k)] != 0)
        for (int row = 0; row < 4; ++row) wanted_[node_row(j + (row & 1), k + (row >> 1))] = 1;
}

void RowReach::forget() { std::ranges::fill(reach_, 0); }

void RowReach::look(std::int64_t j, std::int64_t k, std::int64_t begin, std::int64_t end) {
  const std::int64_t n = lattice_.layout.index(begin, j, k);
  Range& range = range_[node_row(j, k)];
  for (std::size_t c = 0; c < 3; ++c)
    rows_.range(velocity_.component(static_cast<int>(c)) + n, end - begin, &range.low[c], &range.high[c]);
}

void RowReach::note(std::int64_t j, std::int64_t k) {
  const std::size_t row = node_row(j, k);
  if (wanted_[row] == 0) return;
  look(j, k, 0, lattice_.layout.owned()[0]);
  noted_[row] = 1;
}

// The ghosts at both ends of a row.
void RowReach::add_ends(std::int64_t j, std::int64_t k) {
  Range& range = range_[node_row(j, k)];
  for (const std::int64_t i : {std::int64_t{-1}, lattice_.layout.owned()[0]})
    for (std::size_t c = 0; c < 3; ++c) {
      const double v = velocity_.component(static_cast<int>(c))[lattice_.layout.index(i, j, k)];
      range.low[c] = std::min(range.low[c], v);
      range.high[c] = std::max(range.high[c], v);
    }
}

// A cell cannot reach its limit before its nodes have moved so far that they could strain it by what it lacks: nodes
// that move by U at most, apart from what they move in common, change its strain by no more than 2 U / d (theory, 12).
void RowReach::spend(double dt) {
  const Int3& owned = lattice_.layout.owned();
  for (std::int64_t k = -1; k <= owned[2]; ++k)
    for (std::int64_t j = -1; j <= owned[1]; ++j) {
      const std::size_t row = node_row(j, k);
      if (wanted_[row] == 0) continue;
      if (noted_[row] == 0) look(j, k, 0, owned[0]);
      if (!whole_) add_ends(j, k);
      noted_[row] = 0;
    }
  for (std::int64_t k = -1; k < owned[2]; ++k)
    for (std::int64_t j = -1; j < owned[1]; ++j) {
      const std::size_t at = cell_row(lattice_.layout, j, k);
      if (kept_[at] == 0) continue;
      const Range *const lower = &range_[node_row(j, k)], *const upper = &range_[node_row(j, k + 1)];
      double square = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        const double low =
            std::min(std::min(lower[0].low[c], lower[1].low[c]), std::min(upper[0].low[c], upper[1].low[c]));
        const double high =
            std::max(std::max(lower[0].high[c], lower[1].high[c]), std::max(upper[0].high[c], upper[1].high[c]));
        square += (high - low) * (high - low);
      }
      reach_[at] -= 0.5 * dt * std::sqrt(square);
    }
}

}  // namespace koshi::failure
