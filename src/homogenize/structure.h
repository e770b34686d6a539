// What fills the box, as far as images of it tell.
#pragma once

#include "koshi/homogenize.h"

namespace koshi::homogenize {

/// Takes five bytes a cell on each rank while it looks (collective). Errors: RunError for 4e9 cells and more.
Structure find_structure(const model::Model& model);

}  // namespace koshi::homogenize
