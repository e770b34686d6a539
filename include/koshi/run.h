// A whole run, from a definition to an output directory.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "koshi/communicator.h"
#include "koshi/definition.h"
#include "koshi/homogenize.h"

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

/// What `koshi homogenize` is told besides its case.
struct HomogenizeOptions {
  homogenize::Boundary boundary = homogenize::Boundary::periodic;  ///< of the six load cases
  bool coarser = false;                                            ///< also with cells of twice the side
  int boxes = 0;  ///< random boxes of each size; those of a periodic body are loaded between smooth plates
};

/// What `koshi homogenize` does: computes the effective stiffness of a periodic case and writes `stiffness.json`,
/// `stiffness.csv`, `directions.csv`, `resolved.toml` and, where they are asked for, `boxes.csv` and `report.html` into
/// the output directory (collective). The tolerance is that of the case's analysis. Errors as run(); a body that is not
/// periodic in x, y and z where the boundary is, a case with loads or boundaries, and plain springs are wrong input.
void homogenize(const model::Definition& definition, const RunOptions& options, const HomogenizeOptions& how,
                const Communicator& communicator);

/// What `koshi check` prints: the resolved input, springs and what they give, sizes, memory, stable step, estimated
/// time.
std::string check(const model::Definition& definition, const Communicator& communicator);

}  // namespace koshi::driver
