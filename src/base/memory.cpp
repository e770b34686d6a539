#include "base/memory.h"

#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <fstream>

namespace koshi {

double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

double peak_memory(const Communicator& communicator) {
  return static_cast<double>(communicator.sum(static_cast<std::int64_t>(peak_memory())));
}

ResidentMemory resident_memory(const Communicator& communicator) {
  // Pages: the address space, what of it is in memory, and what of that is shared with files or other processes.
  std::array<std::int64_t, 3> pages{};
  std::ifstream statm("/proc/self/statm");
  for (std::int64_t& count : pages) statm >> count;
  communicator.sum(pages);
  const auto page = static_cast<double>(sysconf(_SC_PAGESIZE));
  return {page * static_cast<double>(pages[1]), page * static_cast<double>(pages[2])};
}

}  // namespace koshi
