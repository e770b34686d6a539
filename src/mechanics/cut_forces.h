// Cells that a surface cuts: the energy of the part inside in place of a fraction of the whole cell's.
#pragma once

#include <cstdint>
#include <vector>

#include "koshi/spring_lattice.h"
#include "koshi/vector3.h"
#include "mechanics/cell_stress.h"
#include "mechanics/cell_sweep.h"
#include "mechanics/cut_block.h"

namespace koshi::mechanics {

/// Constants of a material with shared springs in cells of side d [m].
CutConstants cut_constants_of(const material::Springs& springs, double d, material::Kinematics kinematics);

/// The cell as one that a surface cuts; null where it is none.
const model::SurfaceCell* surface_cell(const model::SpringLattice& body, std::int64_t cell);

/// Forces [N] on the corners of one cut cell, beside those of its springs, for their displacements [m].
std::array<Vec3, 8> cut_forces(const model::SpringLattice& body, const model::SurfaceCell& cell,
                               const std::array<Vec3, 8>& displacement);

/// What cut cells add to the forces of the cell kernel, which has their springs by the fraction inside: the difference
/// to the energy of the trilinear displacement over the part inside (theory, section 15). Node rotations stay tied to
/// the displacements by the fraction alone, so there are no moments. Factors are read every time, as the kernel does. A
/// node's sum has one order.
class CutForces {
 public:
  /// The lattice must outlive it.
  explicit CutForces(const model::SpringLattice& body);

  /// Makes the forces on rows of owned nodes; ghosts of u up to date.
  template <class T>
  void update(const NodeValues<T>& u, const Rows& rows);
  /// Adds them times `scale` to row (j, k); force[c] points to node i = 0.
  template <class T>
  void add(std::int64_t j, std::int64_t k, T* const* force, double scale = 1) const;

  /// What the cells add to a node's own block of the stiffness, to the 3 x 3 of its displacements.
  struct NodeBlock {
    Int3 node;
    std::array<double, 9> stiffness;
  };
  /// Of all owned nodes that they touch, as in memory.
  std::vector<NodeBlock> node_blocks() const;

 private:
  using NodeForces = std::array<double, 3>;
  void find_nodes();
  template <class T>
  void add_cells(const NodeValues<T>& u, std::size_t first, std::size_t last);
  /// Number of a row of cells, which begin at -1, and of one of owned nodes.
  std::size_t cell_row(std::int64_t j, std::int64_t k) const {
    return static_cast<std::size_t>(j + 1 + (body_.layout.owned()[1] + 1) * (k + 1));
  }
  std::size_t node_row(std::int64_t j, std::int64_t k) const {
    return static_cast<std::size_t>(j + body_.layout.owned()[1] * k);
  }

  const model::SpringLattice& body_;
  std::vector<CutConstants> constants_;  ///< by material
  const std::vector<model::SurfaceCell>& cells_;
  std::vector<std::array<std::int32_t, 3>> low_;        ///< of each cell, its lowest corner
  std::vector<std::array<std::uint32_t, 8>> corners_;   ///< of each cell, among the nodes; not owned: the last one
  std::vector<NodeForces> force_;                       ///< by node, and one for those not owned
  std::vector<std::int32_t> place_;                     ///< of a node in its row
  std::vector<std::uint32_t> first_cell_, first_node_;  ///< by row
};

}  // namespace koshi::mechanics
