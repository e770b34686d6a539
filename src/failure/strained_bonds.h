// The whole bonds of a body in equilibrium that are closest to what they stand.
#pragma once

#include <vector>

#include "failure/bond_breaking.h"

namespace koshi::failure {

/// Finds them, and breaks them. A rank looks at the bonds whose first node it owns.
class StrainedBonds {
 public:
  StrainedBonds(BondBreaking& breaking, const model::Model& model) : breaking_(breaking), model_(model) {}

  /// The most that a bond is stretched or sheared at the state (ghosts up to date), over what it stands; 0 where none
  /// is. Keeps this one and those that have no less than `share` of that (collective).
  double look(double share);
  /// Breaks those of them that are strained to at least this, over what they stand (collective).
  void break_them(double at_least = 0);

 private:
  struct Bond {
    std::int64_t node;
    int slot;
    bool by_shear;
    double strained;  ///< over what it stands
  };
  void look_at_row(std::int64_t j, std::int64_t k, double share);

  BondBreaking& breaking_;
  const model::Model& model_;
  std::vector<Bond> bonds_;
  double most_ = 0;
};

}  // namespace koshi::failure
