// A whole run, from a definition to an output directory.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "koshi/communicator.h"
#include "koshi/definition.h"

namespace koshi::driver {

/// What a run is told besides its case.
struct RunOptions {
  std::filesystem::path directory;         ///< of the output
  bool quiet = false;                      ///< no progress, no summary on the terminal
  std::filesystem::path restart;           ///< checkpoint to go on from; empty: none
  std::vector<std::string> petsc_options;  ///< as on a command line, for static analyses
};

/// Runs a case and writes its output directory (collective). Throws InputError before anything is written when the
/// input is wrong, RunError when the run fails.
void run(const model::Definition& definition, const RunOptions& options, const Communicator& communicator);

/// What `koshi homogenize` does: computes the effective stiffness of a periodic case and writes `stiffness.json`,
/// `stiffness.csv` and `resolved.toml` into the output directory (collective). The tolerance is that of the
/// case's analysis. Errors as run(); a body that is not periodic in x, y and z, a
/// case with loads or boundaries, and plain springs are wrong input.
void homogenize(const model::Definition& definition, const RunOptions& options, const Communicator& communicator);

/// What `koshi check` prints: the resolved input, springs and what they give, sizes, memory, stable step, estimated
/// time.
std::string check(const model::Definition& definition, const Communicator& communicator);

}  // namespace koshi::driver
