// Statistics of phases where cells hold two of them.
#pragma once

#include "koshi/homogenize.h"

namespace koshi::homogenize {

/// Counts the cells of a mixture to the two solids in it, by their shares, with the stress and strain of the cell.
void split_mixtures(const model::Definition& definition, Effective& effective);

}  // namespace koshi::homogenize
