#include "launch.h"

#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <thread>

#include "koshi/error.h"

namespace koshi::app {

bool is_launched() {
  // Set by Open MPI, and by MPICH and its relatives.
  return std::getenv("OMPI_COMM_WORLD_SIZE") != nullptr || std::getenv("PMI_SIZE") != nullptr;
}

void launch(int ranks, const std::vector<std::string>& arguments) {
  // Open MPI refuses to run as root and on fewer cores than ranks unless told; both are the user's decision here.
  setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 0);
  setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 0);
  setenv("OMPI_MCA_rmaps_base_oversubscribe", "1", 0);
  setenv("OMPI_MCA_btl_vader_single_copy_mechanism", "none", 0);
  // Ranks without a core of their own must not spin while they wait for the others.
  if (static_cast<unsigned>(ranks) > std::thread::hardware_concurrency())
    setenv("OMPI_MCA_mpi_yield_when_idle", "1", 0);
  // The rank that fails says why; the launcher's own words about exit codes would bury it.
  setenv("OMPI_MCA_orte_execute_quiet", "1", 0);
  // The launcher passes on what the ranks print; the live line still works if this process has a terminal.
  if (isatty(STDERR_FILENO)) setenv("KOSHI_PROGRESS", "live", 0);
  std::vector<std::string> command{"mpiexec", "-n", std::to_string(ranks), "/proc/self/exe"};
  std::vector<char> self(4096);
  const ssize_t length = readlink("/proc/self/exe", self.data(), self.size());
  if (length > 0) command.back().assign(self.data(), static_cast<std::size_t>(length));
  command.insert(command.end(), arguments.begin() + 1, arguments.end());
  std::vector<char*> pointers;
  for (std::string& argument : command) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  execvp("mpiexec", pointers.data());
  throw InputError(Place{"--ranks"}, std::string("cannot start mpiexec: ") + std::strerror(errno) +
                                         "; install an MPI launcher (Debian: openmpi-bin), or leave --ranks out");
}

}  // namespace koshi::app
