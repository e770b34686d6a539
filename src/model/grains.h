// Grains of a body, and the cells along their boundaries.
#pragma once

#include <functional>

#include "koshi/definition.h"
#include "koshi/grid.h"

namespace koshi::model {

/// Whether a solid cell has a solid face neighbour of another grain, by the global indices of the cell: grains by
/// body.grain_boundary.labels, else by material. Errors: InputError when there is not a label for each cell. The
/// definition must outlive the function.
std::function<bool(const Int3&)> grain_boundaries(const Definition& definition, const lattice::Grid& grid);

}  // namespace koshi::model
