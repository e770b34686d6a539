// What a cell loses with its springs on the way from one equilibrium to the next.
#pragma once

#include "mechanics/cell_stress.h"

namespace koshi::failure {

/// u.K u'/2 of the springs that the whole cell has, over its volume [J/m^3], with two motions of its corners. It goes
/// with the springs if the body goes from one to the other on a straight line of forces over displacements (theory,
/// section 12, (12.12)).
double joint_energy(const model::SpringLattice& body, std::int64_t cell, const mechanics::CellMotion& before,
                    const mechanics::CellMotion& after);

}  // namespace koshi::failure
