// Components of nodes that do not move, and nodes that springs hold.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "koshi/model.h"
#include "statics/row_field.h"

namespace koshi::statics {

struct FixedNode {
  Int3 node{};            ///< local indices
  std::uint8_t mask = 0;  ///< bit c: component c is fixed
  /// Stiffness of what holds its displacements: xx, yy, zz, yz, xz, xy.
  std::array<float, 6> spring{};
  float stiffness(int a, int b) const { return spring[static_cast<std::size_t>(a == b ? a : 6 - a - b)]; }
  bool sprung() const { return spring != std::array<float, 6>{}; }
};

/// In memory order.
using FixedNodes = std::vector<FixedNode>;

/// Nodes of the rank of which motions prescribe components; of no springs.
FixedNodes fixed_nodes(const model::Model& model);

/// On the next coarser level a component is fixed where it is fixed on one of the eight fine nodes 2 I + {0, 1}^3. A
/// fixed face between two coarse planes thus moves by one fine cell, and a single fixed node stays a single node. (Only
/// coincident nodes: the coarse body would come loose. All nodes nearby: a fixed point would grow into a clamped
/// block.) A coarse node beyond the body's last one acts on that one alone and is fixed with it: left free, it would
/// release on the coarse level what a wall holds. Springs go with their nodes. `owned`: nodes of the rank on both
/// levels.
FixedNodes coarsened(const FixedNodes& fine, const Int3& owned, const Int3& coarse_owned);

/// Sets the fixed components to zero.
void clear_fixed(const FixedNodes& fixed, RowField<float>& field);

}  // namespace koshi::statics
