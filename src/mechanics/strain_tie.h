// What ties the uniform strain of a cell to its other motions: the springs of whole cells have it, those of bodies that
// surfaces cut do not.
#pragma once

#include <Eigen/Core>

#include "koshi/spring_lattice.h"
#include "mechanics/cell_stress.h"

namespace koshi::mechanics {

/// Whether the cells of a body have the tie: its forces cancel between the eight cells around a node, but not beside
/// cells that a surface cuts (theory, section 15).
inline bool strain_is_tied(const model::SpringLattice& body) { return body.fraction.components() == 0; }

/// Stress s [Pa] in a motion, so that the tie's energy is the cell's volume times the sum of s_ij and the strain of the
/// motion: of a cell with these shared springs, side d [m]. Linear; zero in uniform strain.
Tensor6 tie_stress(const material::Springs& springs, double d, const CellMotion& motion);

/// A cell matrix (cell_matrix.h) without the tie: never of less than no energy, if that with it is not.
Eigen::MatrixXd without_tie(const Eigen::MatrixXd& K);

}  // namespace koshi::mechanics
