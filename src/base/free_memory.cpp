#include "base/free_memory.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <sstream>
#include <utility>

namespace koshi {
namespace {

namespace fs = std::filesystem;
constexpr double unlimited = std::numeric_limits<double>::infinity();

// The number in a file; `otherwise` if there is none, as in "max".
double number_in(const fs::path& file, double otherwise) {
  std::ifstream stream(file);
  double value = 0;
  return stream >> value ? value : otherwise;
}

// The number behind a key, of a file with a key and a number in each line.
double number_behind(const fs::path& file, const std::string& wanted, double otherwise) {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    std::istringstream words(line);
    std::string key;
    double value = 0;
    if (words >> key >> value && key == wanted) return value;
  }
  return otherwise;
}

// What one group leaves; the two versions name their files differently.
double left_in_group(const fs::path& group, bool second_version) {
  const double most = number_in(group / (second_version ? "memory.max" : "memory.limit_in_bytes"), unlimited);
  const double used = number_in(group / (second_version ? "memory.current" : "memory.usage_in_bytes"), 0);
  const double idle = number_behind(group / "memory.stat", second_version ? "inactive_file" : "total_inactive_file", 0);
  return std::max(most - std::max(used - idle, 0.0), 0.0);
}

double free_in_address_space() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return unlimited;
  const double pages = number_in("/proc/self/statm", 0);
  return std::max(static_cast<double>(limit.rlim_cur) - pages * static_cast<double>(sysconf(_SC_PAGESIZE)), 0.0);
}

}  // namespace

double free_in_control_groups(const std::string& groups, const fs::path& root) {
  double least = unlimited;
  std::istringstream lines(groups);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string controllers = ',' + line.substr(first + 1, second - first - 1) + ',';
    const bool second_version = controllers == ",,";
    if (!second_version && controllers.find(",memory,") == std::string::npos) continue;
    const fs::path top = second_version ? root : root / "memory";
    // A container shows its own group as the root: paths that are not there limit nothing.
    for (fs::path path = fs::path(line.substr(second + 1)).relative_path();; path = path.parent_path()) {
      least = std::min(least, left_in_group(top / path, second_version));
      if (path.empty()) break;
    }
  }
  return least;
}

FreeMemory free_memory(int ranks) {
  std::ifstream own("/proc/self/cgroup");
  std::ostringstream groups;
  groups << own.rdbuf();
  const std::pair<double, const char*> limits[]{
      {1024 * number_behind("/proc/meminfo", "MemAvailable:", unlimited / 1024), "on this machine"},
      {ranks * free_in_address_space(), "within the limit of a process's address space (ulimit -v)"},
      {free_in_control_groups(groups.str(), "/sys/fs/cgroup"), "within the memory limit of its control group"}};
  const auto& [bytes, limit] = *std::min_element(std::begin(limits), std::end(limits),
                                                 [](const auto& a, const auto& b) { return a.first < b.first; });
  return {bytes, limit};
}

}  // namespace koshi
