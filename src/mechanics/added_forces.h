// Forces that count beside those of a lattice's springs.
#pragma once

#include <cstdint>

#include "koshi/field.h"

namespace koshi::mechanics {

/// Forces linear in the displacements of nodes, on few of them.
class AddedForces {
 public:
  virtual ~AddedForces() = default;
  /// Whether there are none on this rank.
  virtual bool empty() const = 0;
  /// Forces at displacements whose ghosts are up to date.
  virtual void update(const lattice::Field<double>& u) = 0;
  /// Adds the forces on row (j, k) of owned nodes, force[c] pointing to node i = 0.
  virtual void add(std::int64_t j, std::int64_t k, double* const* force) const = 0;
};

}  // namespace koshi::mechanics
