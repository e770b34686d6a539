// Cracks that a body has from the start.
#pragma once

#include "koshi/model.h"

namespace koshi::model {

/// Whether each of the definition's cracks cuts something, and only what can crack. Errors (collective): InputError at
/// a crack that cuts no solid cell, or no bond where bonds break, or one of a material which cannot crack.
void check_pre_cracks(const Model& model);

/// Cracks in State::crack the cells that the definition's cracks cut: a whole plane of a normal cuts d (|n1| + |n2| +
/// |n3|) of cells, and these part the nodes on its two sides. A cell that has cracked through stays as it is.
void add_cracks(const Model& model, lattice::Field<double>& field);

/// Where bonds break: breaks in the first component of State::bonds those that cross the definition's cracks.
void break_bonds(const Model& model, lattice::Field<double>& bonds);

}  // namespace koshi::model
