// A cube cut by a plane.
#pragma once

#include "koshi/vector3.h"

namespace koshi::model {

/// Part of a cube of edge 1 about the origin where normal . x <= offset; the normal need not have length 1, but not 0.
/// Good to about 1e-8.
double part_below(const Vec3& normal, double offset);

/// The offset for which part_below() is `part`, 0 ... 1.
double offset_of_part(const Vec3& normal, double part);

}  // namespace koshi::model
