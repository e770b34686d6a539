#include "mechanics/ground_forces.h"

#include <algorithm>
#include <utility>

#include "mechanics/corners.h"

namespace koshi::mechanics {
GroundForces::GroundForces(const model::SpringLattice& lattice)
    : lattice_(lattice), tension_(lattice.ground.size(), 0) {
  if (lattice.ground.empty()) return;
  const Int3& owned = lattice.layout.owned();
  std::vector<std::pair<std::int64_t, Entry>> by_row;
  for (std::size_t s = 0; s < lattice.ground.size(); ++s) {
    const model::GroundSpring& spring = lattice.ground[s];
    const Int3 cell = lattice.layout.place(spring.cell);
    for (int a = 0; a < 8; ++a) {
      const auto at = corner(a);
      const Int3 node{cell[0] + at[0], cell[1] + at[1], cell[2] + at[2]};
      if (!lattice.layout.owns(node)) continue;
      by_row.push_back({node[1] + owned[1] * node[2], {node[0], s, spring.weights[static_cast<std::size_t>(a)]}});
    }
  }
  std::ranges::stable_sort(by_row, {}, [](const auto& entry) { return entry.first; });
  for (std::int64_t row = 0; row < owned[1] * owned[2]; ++row) {
    first_.push_back(entries_.size());
    while (entries_.size() < by_row.size() && by_row[entries_.size()].first == row)
      entries_.push_back(by_row[entries_.size()].second);
  }
  first_.push_back(entries_.size());
}

void GroundForces::update(const lattice::Field<double>& u, const Rows& rows) {
  const lattice::Layout& layout = lattice_.layout;
  for (std::size_t s = 0; s < tension_.size(); ++s) {
    const model::GroundSpring& spring = lattice_.ground[s];
    const Int3 cell = layout.place(spring.cell);
    if (cell[1] + 1 < rows.j0 || cell[1] >= rows.j1 || cell[2] + 1 < rows.k0 || cell[2] >= rows.k1) continue;
    double stretch = 0;
    for (int a = 0; a < 8; ++a) {
      const std::int64_t node = spring.cell + layout.offset(corner(a));
      const Vec3 at{u.component(0)[node], u.component(1)[node], u.component(2)[node]};
      stretch += spring.weights[static_cast<std::size_t>(a)] * dot(spring.direction, at);
    }
    tension_[s] = -spring.stiffness * stretch;
  }
}

void GroundForces::add(std::int64_t j, std::int64_t k, double* const* force) const {
  if (entries_.empty()) return;
  const auto row = static_cast<std::size_t>(j + lattice_.layout.owned()[1] * k);
  for (std::size_t e = first_[row]; e < first_[row + 1]; ++e) {
    const auto& [i, spring, weight] = entries_[e];
    const double size = weight * tension_[spring];
    for (std::size_t c = 0; c < 3; ++c) force[c][i] += size * lattice_.ground[spring].direction[c];
  }
}

}  // namespace koshi::mechanics
