#include "base/memory.h"

#include <sys/resource.h>

namespace koshi {

double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

double peak_memory(const Communicator& communicator) {
  return static_cast<double>(communicator.sum(static_cast<std::int64_t>(peak_memory())));
}

}  // namespace koshi
