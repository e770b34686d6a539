// Springs of merged cells: the constants of cell_strip.h, and the matrices they stand for.
#pragma once

#include <array>

#include <Eigen/Core>

#include "mechanics/cell_table.h"

namespace koshi::statics {

using mechanics::CellConstants;

/// The stiffness matrices that belong to unit constants, (8 components)^2, corner a = x + 2 y + 4 z, corner-major;
/// unknowns u and rho = (d/2) w.
std::array<Eigen::MatrixXd, mechanics::cell_constants> cell_basis(int components);

/// A bound on the eigenvalues of B K, B the inverse of K's node blocks, for any body made of cells with these
/// constants and their sums: the largest eigenvalue of the cell's matrix over its own node blocks. (x.K x summed over
/// cells <= bound x.B^-1 x summed over cells; the springs are positive semidefinite.) Throws
/// InputError when the cell's springs do not hold a corner.
double relaxation_bound(const CellConstants& constants, int components);

}  // namespace koshi::statics
