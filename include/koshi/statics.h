// Equilibrium without time stepping.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "koshi/model.h"

namespace koshi::statics {

struct StaticOptions {
  double tolerance = 1e-8;  ///< residual over the right-hand side
  int max_iterations = 500;
  std::vector<std::string> petsc_options;  ///< as on a command line: "-ksp_monitor", ...
  std::function<void(int iteration, double relative_residual)> progress;
};

struct SolveReport {
  int iterations = 0;
  double relative_residual = 0;
  std::int64_t unknowns = 0;
  int levels = 0;
  bool converged = false;
  std::string reason;
  std::vector<double> residual_history;
  double setup_seconds = 0;
  double solve_seconds = 0;
  int projected_motions = 0;
};

/// Fills the state's displacements with the equilibrium under the loads at the end of their histories (collective).
SolveReport solve_static(const model::Model& model, model::State& state, const StaticOptions& options);

}  // namespace koshi::statics
