// What cells at surfaces add to the stiffness of the finest multigrid level.
#pragma once

#include <vector>

#include "mechanics/cut_forces.h"

namespace koshi::statics {

/// Forces in the units of a level: its stiffness is `scale` times the body's, rotations are rho = (d/2) w.
class SurfaceTerms {
 public:
  SurfaceTerms(const model::SpringLattice& body, double scale) : forces_(body), scale_(scale), turn_(2 / body.grid.d) {}

  void update(const mechanics::NodeValues<float>& u, const mechanics::Rows& rows) { forces_.update(u, rows, turn_); }
  void add(std::int64_t j, std::int64_t k, float* const* force) const { forces_.add(j, k, force, scale_, turn_); }
  std::vector<mechanics::CutForces::NodeBlock> node_blocks() const {
    auto blocks = forces_.node_blocks();
    for (auto& block : blocks)
      for (std::size_t at = 0; at < 36; ++at)
        block.stiffness[at] *= scale_ * (at / 6 < 3 ? 1 : turn_) * (at % 6 < 3 ? 1 : turn_);
    return blocks;
  }

 private:
  mechanics::CutForces forces_;
  double scale_, turn_;
};

}  // namespace koshi::statics
