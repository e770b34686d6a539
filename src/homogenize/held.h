// The surface of a box under a mean strain or stress.
#pragma once

#include "koshi/homogenize.h"
#include "mechanics/cell_stress.h"

namespace koshi::homogenize {

/// Mean strains that are solved with the same components held: components of the tensor.
std::vector<std::vector<std::size_t>> groups_of_cases(Boundary boundary);

/// Holds what the boundary type holds in these cases at the motion of the uniform strain: fills model.motions.
void hold_surface(Boundary boundary, const std::vector<std::size_t>& cases, model::Model& model);

/// Forces [N] of a stress of 1 Pa of component j on the surface, as a right-hand side of the equations of equilibrium.
void surface_forces(const model::Model& model, std::size_t j, double* right_hand_side);

/// Mean strain (tensor components) by the displacements of the surface; the same bits on any ranks (collective).
mechanics::Tensor6 surface_strain(const model::Model& model, const lattice::Field<double>& u);

/// Refuses voids on the surface (collective).
void require_whole_surface(const model::Model& model);

}  // namespace koshi::homogenize
