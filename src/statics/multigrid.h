// A multigrid V-cycle in single precision, the preconditioner of the equilibrium solver.
//
// Not PETSc's PCMG: its levels are vectors in double precision, and its smoothers pass over memory once for the
// operator and again for each vector operation. Here a sweep reads and writes each value once, at half the width.
//
// A V-cycle, not a W-cycle: merged cells are softer than their interpolated motions, without bound near nu = 1/2, and a
// second visit of a level that overshoots by more than two would make the preconditioner indefinite.
#pragma once

#include <memory>
#include <vector>

#include "statics/coarse_solver.h"
#include "statics/level.h"

namespace koshi::statics {

struct CycleOptions {
  int degree = 3;                   ///< of the relaxation, before and after the coarser level
  double bound = 0;                 ///< of the relaxation, relaxation_bound()
  double shift = 0;                 ///< of the coarsest level, CoarseSolver
  bool serial = false;              ///< one rank only
  SurfaceTerms* surface = nullptr;  ///< what cells at surfaces add, on the finest level
};

/// Levels from a given one down to a direct solve. Once a level is small, or its cells cannot be merged within the
/// ranks, every rank gets the whole of it and goes on alone.
class Hierarchy {
 public:
  /// `constants` with ghosts, normalised to about one; those of a level are free again before its fields take memory
  /// (collective).
  Hierarchy(const LevelGrid& grid, int components, RowField<float> constants, const FixedNodes& fixed,
            const CycleOptions& options);
  ~Hierarchy();

  /// One cycle: finest().x = M finest().b, M close to the inverse of K, symmetric and positive (collective).
  void cycle() { cycle(0); }
  Level& finest() { return *levels_.front(); }
  int level_count() const;

 private:
  class Gathered;
  void cycle(std::size_t l);

  CycleOptions options_;
  std::vector<std::unique_ptr<Level>> levels_;
  std::unique_ptr<CoarseSolver> coarse_;  ///< of the last level, when serial
  std::unique_ptr<Gathered> gathered_;    ///< the last level and all below it on every rank, when not
};

}  // namespace koshi::statics
