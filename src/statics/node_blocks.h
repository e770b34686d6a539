// Inverse node blocks of a multigrid level, for relaxation.
#pragma once

#include <cstdint>
#include <vector>

#include "mechanics/cut_forces.h"
#include "mechanics/relax_rows.h"
#include "statics/fixed_nodes.h"
#include "statics/spring_rows.h"

namespace koshi::statics {

/// The inverse of each node's own block of the stiffness matrix, with the springs that hold it, 6 x 6 or 3 x 3; zero in
/// rows and columns of fixed components and for nodes without a cell. Nodes come in groups of mechanics::block_width
/// along a row; groups with equal surroundings share their blocks, and inside a uniform material a block is just two
/// numbers. Elements are integers of two bytes, 1/32767 of the largest each: half the memory, and an error far below
/// what relaxation feels.
class NodeBlocks {
 public:
  /// Springs hold every corner of a cell (relaxation_bound() has checked them). `more`: what blocks have beside that of
  /// the springs, in memory's order.
  NodeBlocks(const SpringRows& springs, const FixedNodes& fixed, int components,
             const std::vector<mechanics::CutForces::NodeBlock>& more = {});

  /// Blocks of row (j, k) for RelaxRow; null when the row has no node with a cell.
  const std::int32_t* row(std::int64_t j, std::int64_t k) const {
    const std::int64_t at = j + owned_y_ * k;
    return empty_[static_cast<std::size_t>(at)] != 0 ? nullptr : groups_.data() + at * groups_per_row_;
  }
  const float* uniform() const { return uniform_.data(); }
  const std::int16_t* blocks() const { return blocks_.data(); }
  const float* units() const { return units_.data(); }

 private:
  std::int64_t owned_y_, groups_per_row_;
  std::vector<std::int32_t> groups_;
  std::vector<std::uint8_t> empty_;
  std::vector<float> uniform_;
  std::vector<std::int16_t> blocks_;  ///< a set of lower triangles for each group
  std::vector<float> units_;          ///< of them, by group and node
};

}  // namespace koshi::statics
