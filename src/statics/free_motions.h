// Rigid-body motions that nothing holds, part by part.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "base/exact_sum.h"
#include "statics/equilibrium.h"
#include "statics/parts.h"

namespace koshi::statics {

/// The rigid-body motions of each part that the prescribed components and the ground leave free. The stiffness cannot
/// resist them: the right-hand side must not push along them, and the solution is made free of them.
class FreeMotions {
 public:
  /// Finds them (collective).
  FreeMotions(const model::Model& model, const FixedNodes& fixed);

  /// Number of free motions of all parts.
  int count() const;
  /// Throws InputError, naming part and motion, when the right-hand side does work on a free motion (collective).
  void require_balance(const double* b) const;
  /// Takes the free motions out of a vector of unknowns (collective).
  void project(double* x) const;
  /// Takes them out of values on the nodes of a level, whose rotations are rho = (d/2) w as well; sums along rows are
  /// rounded (collective).
  void project(RowField<float>& x) const;
  /// Amounts of three translations and three rotations about each free part's centre.
  using Amounts = std::vector<Eigen::Matrix<double, 6, 1>>;
  /// Work of a vector of unknowns on the six motions of each free part (collective).
  Amounts work(const double* x) const { return work(x, false); }
  /// x -= these motions.
  void subtract(const Amounts& motion, double* x) const;
  /// Free motions of each free part, columns of Amounts, orthonormal as vectors of unknowns.
  const Eigen::MatrixXd& motions(std::size_t free_part) const { return free_[free_part].motions; }
  std::size_t free_part_count() const { return free_.size(); }
  int part_count() const { return static_cast<int>(parts_.list().size()); }
  /// What is free, in words; empty when nothing is.
  std::string description() const;

 private:
  /// Motions of one part about its centre: columns of three translations and three rotations, lengths in cells,
  /// orthonormal as vectors of unknowns (Equilibrium, divided by d).
  struct FreePart {
    std::int32_t part;
    Vec3 centre;  ///< [cells]
    double size;  ///< the largest of its extents [cells]
    Eigen::MatrixXd motions;
    bool turns;  ///< whether some motion is not a translation
  };
  /// With `absolute`, work of the absolute values of the terms.
  Amounts work(const double* x, bool absolute) const;
  Amounts amounts(std::vector<ExactSum>& sums) const;
  /// From work on the six motions to the part along the free ones.
  void keep_free(Amounts& motion) const;
  template <class F>
  void for_each_free_node(F&& use) const;
  std::string title(std::int32_t part) const;
  static std::string in_words(const Eigen::MatrixXd& motions);

  const model::Model& model_;
  int components_;
  Parts parts_;
  std::vector<FreePart> free_;
  std::vector<std::int32_t> free_of_node_;  ///< by owned node: index into free_, or -1; empty when nothing is free
};

}  // namespace koshi::statics
