// Cracks that a body has from the start.
#pragma once

#include "koshi/model.h"

namespace koshi::model {

/// Cracks the cells that the definition's cracks cut: a whole plane of a normal cuts d (|n1| + |n2| + |n3|) of cells,
/// and these part the nodes on its two sides. A cell that has cracked through stays as it is. Errors (collective):
/// InputError at a crack that cuts no solid cell, or one whose material cannot crack.
void add_cracks(const Model& model, lattice::Field<double>& crack);

}  // namespace koshi::model
