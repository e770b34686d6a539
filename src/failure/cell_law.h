// How one cell cracks: criterion, softening and crack faces put together. Knows no lattice, no rank, no solver.
#pragma once

#include <optional>

#include "failure/crack_faces.h"
#include "failure/criterion.h"
#include "failure/softening.h"
#include "koshi/springs.h"

namespace koshi::failure {

/// What a cracked cell remembers. A cell that never reached its strength has none.
struct Crack {
  Vec3 normal{};        ///< of the plane that cracked first; stays
  Vec3 slip{};          ///< of the closed faces over the cell's width
  double strength = 1;  ///< factor on the material's strength
  double kappa = 0;     ///< largest equivalent strain so far
  double damage = 0;    ///< omega: the cell's springs count 1 - omega; never falls
};

/// The law of one material in cells of side d [m].
class CellLaw {
 public:
  CellLaw(const material::Elastic& elastic, const material::Fracture& fracture, double d);

  /// Equivalent strain below which no cell cracks whose strength has this factor, whatever the direction.
  double safe(double strength_factor) const;
  /// Never below the equivalent strain (equivalent elastic stress)/E at this strain; cheap.
  double bound(const Tensor6& strain) const {
    return criterion_.bound(elastic_stress(lambda_, mu_, strain)) / youngs_modulus_;
  }
  /// A cell without a crack at this strain: the crack it gets, or nothing.
  std::optional<Crack> onset(const Tensor6& strain, double strength_factor) const;
  /// Raises kappa and the damage of a cracked cell to what this strain asks for.
  void soften(Crack& crack, const Tensor6& strain) const;
  /// Lets the closed faces of the crack slide as far as their friction lets them; the energy [J/m^3] that takes, for a
  /// fully cracked cell.
  double slide_faces(Crack& crack, const Tensor6& strain) const;
  /// What the closed faces of the crack carry; times the damage.
  FaceContact faces(const Crack& crack, const Tensor6& strain) const {
    return face_contact({youngs_modulus_, mu_}, crack.normal, crack.slip, strain);
  }

 private:
  Softening softening(const Vec3& normal, double strength_factor) const;

  double youngs_modulus_, lambda_, mu_;
  material::Fracture fracture_;
  Criterion criterion_;
  double friction_;
  double d_;
};

}  // namespace koshi::failure
