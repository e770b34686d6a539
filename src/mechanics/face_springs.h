// Springs across single cells, beside those of the lattice: what closed cracks carry in equilibrium.
#pragma once

#include <vector>

#include "koshi/spring_lattice.h"
#include "koshi/vector3.h"
#include "mechanics/added_forces.h"
#include "mechanics/corner_forces.h"

namespace koshi::mechanics {

/// Resists the strain e = n.eps.n of a cell along one direction with the energy d^3 stiffness e^2/2.
struct FaceSpring {
  std::int64_t cell;  ///< index of its lowest corner
  Vec3 normal;        ///< n, unit vector
  double stiffness;   ///< [Pa]
};

/// A set of such springs. One that every rank has of a cell whose corners it owns gives the same forces on any ranks.
class FaceSprings : public AddedForces {
 public:
  /// `force`: memory for three components, zero; the forces of the last update() from then on. Both outlive this.
  FaceSprings(const model::SpringLattice& body, lattice::Field<double>& force);

  /// Takes other springs, by cell in ascending order; the forces are zero until the next update().
  void set(std::vector<FaceSpring> springs);
  const std::vector<FaceSpring>& springs() const { return springs_; }

  bool empty() const override { return springs_.empty(); }
  void update(const lattice::Field<double>& u) override;
  void add(std::int64_t j, std::int64_t k, double* const* force) const override { forces_.add(j, k, force); }

 private:
  void clear();

  const model::SpringLattice& body_;
  lattice::Field<double>& force_;
  std::vector<FaceSpring> springs_;
  CornerForces forces_;  ///< of the same memory
};

/// n.eps.n of the strain of a cell.
double strain_along(const model::SpringLattice& body, const lattice::Field<double>& u, std::int64_t cell,
                    const Vec3& normal);

}  // namespace koshi::mechanics
