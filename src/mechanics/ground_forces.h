// Forces of the springs between a body and the ground.
#pragma once

#include <vector>

#include "koshi/spring_lattice.h"
#include "mechanics/cell_sweep.h"

namespace koshi::mechanics {

/// Forces of SpringLattice::ground on the owned nodes of the lattice, which must outlive it. The forces on a node are
/// added in the order of the springs, so they have the same bits on any ranks.
class GroundForces {
 public:
  explicit GroundForces(const model::SpringLattice& lattice);

  bool empty() const { return entries_.empty(); }
  /// Takes the displacements for rows of owned nodes: those within and next to them, ghosts too, must be up to date.
  void update(const lattice::Field<double>& u, const Rows& rows);
  /// Adds the forces on row (j, k), one of those, to force[c], which points to node i = 0.
  void add(std::int64_t j, std::int64_t k, double* const* force) const;

 private:
  /// What a spring does to a node.
  struct Entry {
    std::int64_t i;  ///< along the row
    std::size_t spring;
    double weight;
  };
  const model::SpringLattice& lattice_;
  std::vector<Entry> entries_;      ///< by row, then in the order of the springs
  std::vector<std::size_t> first_;  ///< entry of each row, and the end
  std::vector<double> tension_;     ///< force on the body along the direction, by spring [N]
};

}  // namespace koshi::mechanics
