// The least-squares rotation with plain springs.
#pragma once

#include "koshi/spring_lattice.h"

namespace koshi::mechanics {

/// Adds, for nodes first <= i < last of row (j, k), what the rotation w of each cell around the node takes off its
/// bonds. A bond's stiffness is split evenly among its solid cells, so on a surface a cell's parts are uneven and the
/// moment T = sum D x F of its bonds about w does not vanish (with shared springs it does): the force on corner s is w
/// x sum(kt D) + T x s / (8 d).
template <class T>
void add_plain_fit(const model::SpringLattice& body, const lattice::Field<T>& u, std::int64_t j, std::int64_t k,
                   std::int64_t first, std::int64_t last, T* const force[6]);

}  // namespace koshi::mechanics
