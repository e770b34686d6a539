// Memory in use.
#pragma once

#include "koshi/communicator.h"

namespace koshi {

/// The most memory this process has held so far [bytes].
double peak_memory();

/// The sum of the ranks' peaks [bytes] (collective).
double peak_memory(const Communicator& communicator);

/// Memory that processes hold now [bytes].
struct ResidentMemory {
  double all = 0;
  double shared = 0;  ///< of it, pages of the program's and its libraries' files, and what ranks share
};

/// The sum over the ranks (collective). Libraries' files are read page by page, when a page is first used; how much of
/// them a process holds depends on the machine.
ResidentMemory resident_memory(const Communicator& communicator);

}  // namespace koshi
