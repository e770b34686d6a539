// The plain kernel: forces straight from the bond law, node by node and bond by bond. It is the specification of the
// cell kernel, and serves plain springs, which are no sum over cells with constants of their own.
#pragma once

#include <vector>

#include "koshi/spring_lattice.h"

namespace koshi::mechanics {

/// F = -K u for any springs; slow. The lattice must outlive it; its factors count as they are now.
class PlainForces {
 public:
  explicit PlainForces(const model::SpringLattice& lattice);

  /// Forces [N] and moments [N m] on the nodes of row (j, k), `force` by component, pointing to node i = 0, with
  /// room for whole lines of 64 bytes. Ghosts of u must be up to date.
  void row(const lattice::Field<double>& u, std::int64_t j, std::int64_t k, double* const* force) const;

 private:
  void add_bonds(const lattice::Field<double>& u, std::int64_t first, double* const* force) const;
  void add_cells(const lattice::Field<double>& u, std::int64_t first, double* const* force) const;

  const model::SpringLattice& lattice_;
  lattice::Field<double> own_bond_;  ///< of shared springs, which the lattice does not keep
  lattice::Field<std::uint8_t> own_bond_cells_;
  const lattice::Field<double>& bond_;
  std::vector<int> slots_;  ///< those with springs
  bool by_cell_;            ///< is there anything that belongs to cells?
};

}  // namespace koshi::mechanics
