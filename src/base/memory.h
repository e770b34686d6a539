// Memory in use.
#pragma once

#include "koshi/communicator.h"

namespace koshi {

/// The most memory this process has held so far [bytes].
double peak_memory();

/// The sum of the ranks' peaks [bytes] (collective).
double peak_memory(const Communicator& communicator);

}  // namespace koshi
