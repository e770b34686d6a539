// The dense stiffness matrix of one isolated cell, summed bond by bond from the bond law: what every kernel, every
// self-check and the dispersion relation are compared with or made from.
#pragma once

#include <Eigen/Core>

#include "koshi/lattice.h"
#include "koshi/springs.h"
#include "mechanics/corners.h"

namespace koshi::mechanics {

/// Unknowns per node: ux uy uz wx wy wz, or ux uy uz.
constexpr int components(material::Kinematics kinematics) {
  return kinematics == material::Kinematics::rotational ? 6 : 3;
}

/// Stiffness of one cell of side d [m] with its shares of the bonds (edges 1/4, face diagonals 1/2, body diagonals 1)
/// and its volumetric spring: symmetric, 48 x 48 (rotational) or 24 x 24 (least-squares), node-major. Forces on the
/// corners [N], then moments [N m], are minus this matrix times displacements [m] and rotations [rad].
Eigen::MatrixXd cell_matrix(const material::Springs& springs, double d, material::Kinematics kinematics);

}  // namespace koshi::mechanics
