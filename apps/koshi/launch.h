// Starting the program on several ranks.
#pragma once

#include <string>
#include <vector>

namespace koshi::app {

/// Whether this process was started by an MPI launcher.
bool is_launched();

/// Runs `mpiexec -n ranks` with the same arguments and ends this process with its exit code. SIGINT and SIGTERM ask the
/// ranks to stop after a checkpoint. Throws RunError if no process can be started.
[[noreturn]] void launch(int ranks, const std::vector<std::string>& arguments);

}  // namespace koshi::app
