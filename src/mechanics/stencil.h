// Stencils of a node inside one material, and of one in a flat face across x.
#pragma once

#include "koshi/springs.h"
#include "mechanics/row_kernels.h"

namespace koshi::mechanics {

/// Stencil of F = -K u, summed from the eight cells around a node; d [m] the spacing.
template <class T>
Stencil<T> make_stencil(const material::Springs& springs, double d, material::Kinematics kinematics);

/// The same for shared springs of a node with the four cells towards x = +1 or -1 only.
template <class T>
FaceStencil<T> make_face_stencil(const material::Springs& springs, double d, material::Kinematics kinematics,
                                 int toward);

}  // namespace koshi::mechanics
