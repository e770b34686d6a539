// PETSc vectors whose sums do not depend on the number of ranks.
#pragma once

#include "statics/petsc.h"

namespace koshi::statics {

/// From now on inner products and norms of this vector, and of those that PETSc makes in its likeness, are sums without
/// rounding, and sums of vectors are done element by element: an iteration then gives the same bits on any number of
/// ranks.
void use_exact_sums(Vec vector);

}  // namespace koshi::statics
