// The 27-point stencil of a node inside one material.
#pragma once

#include "koshi/springs.h"
#include "mechanics/row_kernels.h"

namespace koshi::mechanics {

/// Stencil of F = -K u, summed from the eight cells around a node; d [m] the spacing.
template <class T>
Stencil<T> make_stencil(const material::Springs& springs, double d, material::Kinematics kinematics);

}  // namespace koshi::mechanics
