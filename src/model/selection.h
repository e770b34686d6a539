// Which nodes and which surfaces a boundary, load or probe applies to.
#pragma once

#include <string>
#include <vector>

#include "koshi/model.h"

namespace koshi::model {

/// A box of nodes by global indices, both ends included; every selection is one.
struct NodeBox {
  Int3 lo{}, hi{};

  bool contains(const Int3& node) const {
    for (int a = 0; a < 3; ++a)
      if (node[a] < lo[a] || node[a] > hi[a]) return false;
    return true;
  }
};

/// The nodes of a selection; `path` is its table in the input ("boundary[0]"), for error messages. Throws InputError
/// when no node of the grid is meant.
NodeBox select(const Selection& selection, const lattice::Grid& grid, const Places& places, const std::string& path);

/// One selected node: its index and its part of the selected surface, the sum of d^2/4 n over the faces between solid
/// and empty cells around it whose four corners are selected; `area` is the sum of d^2/4.
struct SelectedNode {
  std::int64_t node = 0;
  Int3 global{};
  Vec3 outward{};   ///< [m^2]
  double area = 0;  ///< [m^2]
};

/// Owned nodes of the box that have a cell, in memory order.
std::vector<SelectedNode> selected_nodes(const SpringLattice& body, const NodeBox& box);

}  // namespace koshi::model
