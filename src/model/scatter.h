// Stiffness and strength that differ from cell to cell: random factors, factors from a file, weaker grain boundaries.
#pragma once

#include <functional>

#include "koshi/model.h"

namespace koshi::model {

/// The factor that a standard normal number stands for: mean 1, by the distribution of the scatter.
double scattered(const material::Scatter& scatter, double normal_number);

/// Multiplies the factors of the lattice's cells by the scatter of their material's stiffness; bodies without any keep
/// theirs.
void scatter_stiffness(const Definition& definition, SpringLattice& body);

/// Factors on the strength of the lattice's cells; no components where all are 1. Errors: InputError when body.strength
/// has not one for each cell, or one that is not positive.
lattice::Field<float> strength_of_cells(const Definition& definition, const SpringLattice& body);

}  // namespace koshi::model
