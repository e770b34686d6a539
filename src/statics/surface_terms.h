// What cells at surfaces add to the stiffness of the finest multigrid level.
#pragma once

#include <vector>

#include "mechanics/cut_forces.h"

namespace koshi::statics {

/// Forces in the units of a level: its stiffness is `scale` times the body's.
class SurfaceTerms {
 public:
  SurfaceTerms(const model::SpringLattice& body, double scale) : forces_(body), scale_(scale) {}

  void update(const mechanics::NodeValues<float>& u, const mechanics::Rows& rows) { forces_.update(u, rows); }
  void add(std::int64_t j, std::int64_t k, float* const* force) const { forces_.add(j, k, force, scale_); }
  std::vector<mechanics::CutForces::NodeBlock> node_blocks() const {
    auto blocks = forces_.node_blocks();
    for (auto& block : blocks)
      for (double& entry : block.stiffness) entry *= scale_;
    return blocks;
  }

 private:
  mechanics::CutForces forces_;
  double scale_;
};

}  // namespace koshi::statics
