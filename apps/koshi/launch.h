// Starting the program on several ranks.
#pragma once

#include <string>
#include <vector>

namespace koshi::app {

/// Whether this process was started by an MPI launcher.
bool is_launched();

/// Replaces this process by `mpiexec -n ranks` with the same arguments. Returns only on failure, with InputError.
[[noreturn]] void launch(int ranks, const std::vector<std::string>& arguments);

}  // namespace koshi::app
