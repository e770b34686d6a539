// Memory of a run.
#pragma once

#include "koshi/definition.h"

namespace koshi::model {

/// Throws InputError with the spacing that would fit when the run needs more memory than is free.
void check_memory(const Definition& definition, int ranks);

}  // namespace koshi::model
