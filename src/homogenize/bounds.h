// Bounds of effective moduli from the volumes of the phases.
#pragma once

#include "koshi/homogenize.h"

namespace koshi::homogenize {

/// Every cell of the box is a phase by its material and factor; voids have no stiffness (collective).
Bounds find_bounds(const model::Model& model);

}  // namespace koshi::homogenize
