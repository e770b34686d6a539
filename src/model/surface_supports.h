// Supports by the surfaces of regions.
#pragma once

#include <vector>

#include "koshi/model.h"

namespace koshi::model {

/// So far below the surface a support takes hold of the body, in spacings.
inline constexpr double support_depth = 0.2;

/// Thickness in spacings of the layer of material that gives way as a spring does which takes hold of a cell of which
/// the part `fraction` is inside, so that the surface itself stays where it is (15.7).
double support_layer(double fraction);

/// The springs of all boundaries with a support, in cells that touch an owned node, in one order on any ranks: one for
/// the pieces of a surface in each cell, three where it is bonded. Each has the true normal of the region. Throws
/// InputError when a selection holds no surface of the body.
std::vector<GroundSpring> make_supports(const Model& model);

}  // namespace koshi::model
