// Equilibrium without time stepping.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "koshi/model.h"

namespace koshi::statics {

/// How a solution is sought.
struct StaticOptions {
  double tolerance = 1e-8;                                                ///< residual over the right-hand side
  int max_iterations = 500;                                               ///< RunError beyond
  std::vector<std::string> petsc_options;                                 ///< as on a command line: "-ksp_monitor", ...
  std::function<void(int iteration, double relative_residual)> progress;  ///< called after each iteration; empty: not
  std::function<bool()> stop;  ///< called after each iteration by all ranks; true on all: give up; empty: never
};

/// What a periodic body does as a whole; tensor components xx, yy, zz, yz, xz, xy.
struct Macroscopic {
  std::array<double, 6> strain{};  ///< mean strain
  std::array<double, 6> stress{};  ///< mean stress over the box, voids too [Pa]
  int solves = 0;                  ///< that it took to find the strain that the mean stress needs
};

/// How it went.
struct SolveReport {
  int iterations = 0;                       ///< of conjugate gradients, of all solves
  std::optional<Macroscopic> macroscopic;   ///< unset without a macroscopic strain
  double relative_residual = 0;             ///< at the end, over the right-hand side
  std::int64_t unknowns = 0;                ///< free components of all nodes
  int levels = 0;                           ///< of the multigrid hierarchy
  bool converged = false;                   ///< to the tolerance
  bool stopped = false;                     ///< StaticOptions::stop asked for it
  std::string reason;                       ///< why it ended, in words
  std::vector<double> residual_history;     ///< relative residual after 0, 1, 2 ... iterations
  double setup_seconds = 0;                 ///< wall time before the iterations [s]
  double solve_seconds = 0;                 ///< wall time of the iterations [s]
  int projected_motions = 0;                ///< rigid motions that nothing holds, taken out
  std::string free_motions;                 ///< the same in words, part by part; empty when all parts are held
  std::vector<std::string> unused_options;  ///< PETSc options that nothing asked for
};

/// The time [s] at which loads and motions are taken: when all histories and ramps have ended, or the duration.
double end_time(const model::Definition& definition);

/// Fills the state's displacements with the equilibrium under the loads at the end of their histories and the
/// macroscopic strain, which it finds where its stress is given; velocities are zero (collective). Throws InputError
/// when the loads move a part that nothing holds, RunError when the iteration does not converge or no strain leads to
/// the stress; displacements are not defined then. A solve that is stopped leaves those of its last iteration.
SolveReport solve_static(const model::Model& model, model::State& state, const StaticOptions& options);

}  // namespace koshi::statics
