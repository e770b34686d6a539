// A periodic body under a mean strain.
#pragma once

#include "koshi/model.h"
#include "mechanics/cell_stress.h"

namespace koshi::mechanics {

/// Adds u = E x to the displacements of all nodes, x their distance from the grid's lower corner. Ghosts across a
/// period L get the affine continuation u(x + L) = u(x) + E L, where an exchange would give them u(x).
void add_uniform_strain(const model::Model& model, const Tensor6& strain, lattice::Field<double>& u);

/// The displacement E x [m] of the node with this number in the whole grid.
Vec3 uniform_displacement(const model::Model& model, const Tensor6& strain, const Int3& node);

/// Fills the ghosts of displacements, those across a period L with u + E L (collective).
void exchange_displacements(const model::Model& model, const Tensor6& strain, lattice::Field<double>& u);

/// Adds E L to ghosts across a period L, which an exchange gave u(x).
void add_periods(const model::Model& model, const Tensor6& strain, lattice::Field<double>& u);

/// The mean strain that the definition's [macroscopic] gives at a time; zero where it gives the stress.
Tensor6 given_strain(const model::Definition& definition, double time);

/// Whether component c of the strain has a mean: the body has periods along both of its axes.
bool has_mean_strain(const model::Model& model, std::size_t c);

/// Mean stress [Pa] over the whole box, voids too; ghosts of u set. The bits do not depend on the ranks (collective).
Tensor6 mean_stress(const model::Model& model, const lattice::Field<double>& u);

/// Residual [N] that rounding leaves where a mean strain of 1 is uniform, a 2-norm over all unknowns.
double rounding_residual(const model::Model& model);

}  // namespace koshi::mechanics
