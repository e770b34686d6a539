// Percentiles over all ranks.
#pragma once

#include <vector>

#include "koshi/communicator.h"

namespace koshi::mechanics {

/// A value and the nodes or the area it stands for.
struct Weighted {
  double value = 0, weight = 1;
};

/// The value, with its sign, whose size this part [%] of all ranks' values does not exceed: the first, by size, up to
/// which that part of the weights lies. The same for any number of ranks (collective); 0 without values.
double percentile(const Communicator& communicator, const std::vector<Weighted>& values, double percent);

}  // namespace koshi::mechanics
