// A periodic body under a mean strain.
#pragma once

#include "koshi/model.h"
#include "mechanics/cell_stress.h"

namespace koshi::statics {

/// Adds u = E x to the displacements of all nodes, x their distance from the grid's lower corner. Ghosts across a
/// period L get the affine continuation u(x + L) = u(x) + E L, where an exchange would give them u(x).
void add_uniform_strain(const model::Model& model, const mechanics::Tensor6& strain, lattice::Field<double>& u);

/// Mean stress [Pa] over the whole box, voids too; ghosts of u set. The bits do not depend on the ranks (collective).
mechanics::Tensor6 mean_stress(const model::Model& model, const lattice::Field<double>& u);

}  // namespace koshi::statics
