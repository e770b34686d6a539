// Memory that a run may still take.
#pragma once

#include <filesystem>
#include <string>

namespace koshi {

/// The least of what the machine has free and what limits leave.
struct FreeMemory {
  double bytes = 0;
  std::string limit;  ///< what sets it, as "on this machine"
};

/// For a run on this many ranks of this machine: memory of the machine, RLIMIT_AS of each rank, control groups.
FreeMemory free_memory(int ranks);

/// What the control groups of a process leave [bytes], infinity where nothing limits them. `groups`: the lines of
/// /proc/self/cgroup, version 2 ("0::/job") or 1 ("4:memory:/job"); `root`: /sys/fs/cgroup. Every group above the own
/// one counts; pages of files that nothing uses count as free.
double free_in_control_groups(const std::string& groups, const std::filesystem::path& root);

}  // namespace koshi
