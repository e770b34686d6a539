// Which nodes and which surfaces a boundary, load or probe applies to.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "koshi/model.h"

namespace koshi::model {

/// Nodes by global indices: a box, both ends included, or those in it that a predicate names.
struct NodeSet {
  Int3 lo{}, hi{};
  std::function<bool(const Int3&)> named{};  ///< none: the whole box

  bool contains(const Int3& node) const {
    for (int a = 0; a < 3; ++a)
      if (node[a] < lo[a] || node[a] > hi[a]) return false;
    return !named || named(node);
  }
};

/// The nodes of a selection; `path` is its table in the input ("boundary[0]"), for error messages. Nodes of a surface
/// are the corners of the cells that it cuts. Throws InputError when no node of the grid is meant, and for a surface
/// that is none of the body. The definition must outlive the set.
NodeSet select(const Selection& selection, const Definition& definition, const lattice::Grid& grid,
               const std::string& path);

/// The selection that a name stands for, with its place in Definition::selections; check() has found it to be there.
std::size_t find_selection(const Definition& definition, const std::string& name);
/// The region that a name stands for, the same.
int find_region(const Definition& definition, const std::string& name);

/// Regions whose surfaces a selection names, itself or through others, each once, ascending.
std::vector<int> surfaces_of(const Selection& selection, const Definition& definition);

/// Whether a selection holds a place on the surface of a region: its surface names the region, its bodies hold the
/// place; faces and points hold none.
bool holds(const Selection& selection, const Definition& definition, const Vec3& place, int region);

/// One selected node: its index and its part of the selected surface, the sum of d^2/4 n over the faces between solid
/// and empty cells around it whose four corners are selected; `area` is the sum of d^2/4.
struct SelectedNode {
  std::int64_t node = 0;
  Int3 global{};
  Vec3 outward{};   ///< [m^2]
  double area = 0;  ///< [m^2]
};

/// Owned nodes of the set that have a cell, in memory order.
std::vector<SelectedNode> selected_nodes(const SpringLattice& body, const NodeSet& box);

/// A quarter of a face between a solid and an empty cell whose four corners are selected: that of one of its corners.
struct FaceQuarter {
  std::int64_t node = 0;
  Int3 global{};
  int axis = 0;               ///< across the face
  int outward = 0;            ///< direction out of the body along it, 1 or -1
  std::array<int, 2> side{};  ///< where the face lies from the corner along the next axis and the one after, 1 or -1
};

/// Those of owned nodes of the set, in memory order.
std::vector<FaceQuarter> selected_quarters(const SpringLattice& body, const NodeSet& box);

}  // namespace koshi::model
