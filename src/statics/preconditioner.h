// The multigrid cycle between PETSc's vectors.
#pragma once

#include <memory>

#include "statics/free_motions.h"
#include "statics/multigrid.h"

namespace koshi::statics {

/// z = M r, M one cycle in single precision, close to the inverse of the stiffness: symmetric, positive, free motions
/// taken out. All functions are collective.
class Preconditioner {
 public:
  Preconditioner(const model::Model& model, const FixedNodes& fixed, const FreeMotions& free);
  void apply(const double* r, double* z);
  /// The same from the finest level's right-hand side to its solution.
  void cycle();
  Level& finest() { return hierarchy_->finest(); }
  /// Stiffness that the levels take for 1 [N/m].
  double unit() const { return unit_; }
  int level_count() const { return hierarchy_->level_count(); }

 private:
  /// Calls copy(row of the field, unknowns beside it, their number) for all rows and components.
  template <class T, class F>
  void for_each_row(RowField<float>& field, T* unknowns, F&& copy) const;

  int components_;
  double unit_ = 0;
  const FreeMotions& free_;
  std::unique_ptr<SurfaceTerms> surface_;
  std::unique_ptr<Hierarchy> hierarchy_;
};

}  // namespace koshi::statics
