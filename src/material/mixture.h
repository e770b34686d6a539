// Two solids in one cell.
#pragma once

#include "koshi/springs.h"

namespace koshi::material {

/// The isotropic solid that stands for a cell with a part `share` (0 ... 1) of `second` and the rest of `first`: over
/// all directions of the interface it stores on average what the two in layers do under the stretches along the
/// interface and the tractions across it that are those of a ball of `inclusion`, one of the two or between them
/// (theory, 14). Density by volume.
Elastic mixture(const Elastic& first, const Elastic& second, double share, const Elastic& inclusion);

/// Moduli K and G between those of the two: K = K_first^(1 - part) K_second^part.
Elastic geometric_mean(const Elastic& first, const Elastic& second, double part);

}  // namespace koshi::material
