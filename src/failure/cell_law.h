// How one cell cracks: criterion, softening and crack faces put together. Knows no lattice, no rank, no solver.
#pragma once

#include <limits>
#include <optional>

#include "failure/crack_faces.h"
#include "failure/criterion.h"
#include "failure/softening.h"
#include "koshi/springs.h"

namespace koshi::failure {

/// What a cracked cell remembers. A cell that never reached its strength has kappa = 0.
struct Crack {
  Vec3 normal{};  ///< of the plane that cracked first; stays
  Vec3 slip{};    ///< of the closed faces over the cell's width
  /// Of the plane from the middle of the cell along the normal [m]; infinite if no crack goes on along it.
  double offset = std::numeric_limits<double>::infinity();
  double kappa = 0;    ///< largest equivalent strain so far
  double limit = 0;    ///< equivalent strain at the onset
  double onset = 0;    ///< elastic energy at the onset [J/m^3]
  double ratio = 0;    ///< energy that the crack takes in all, over that
  double taken = 0;    ///< energy that it has taken so far, over that
  double damage = 0;   ///< omega: the cell's springs count 1 - omega; never falls
  bool shear = false;  ///< it began by the shear limit
};

/// The law of one material in cells of side d [m].
class CellLaw {
 public:
  CellLaw(const material::Elastic& elastic, const material::Fracture& fracture, double d);

  /// Equivalent strain below which no cell cracks whose strength has this factor, whatever the direction.
  double safe(double strength_factor) const;
  /// Never below the equivalent strain (equivalent elastic stress)/E at a strain with this mean and radius: the stress
  /// has the mean (3 lambda + 2 mu) p and the radius 2 mu r.
  Bound bound() const {
    const Bound of = criterion_.bound();
    const double p = (3 * lambda_ + 2 * mu_) / youngs_modulus_, r = 2 * mu_ / youngs_modulus_;
    return {p * of.p_1, r * of.r_1, p * of.p_2, r * of.r_2};
  }
  /// The crack that this strain leads to in a cell without one, when it has grown or shrunk in proportion until the
  /// equivalent strain is at the limit. In tension it is one across the largest stress; if another crack leads here,
  /// with this unit normal (or 0), and the two are more than 45 degrees apart, it goes on as it did.
  Crack ahead(const Tensor6& strain, double strength_factor, const Vec3& lead = {}) const;
  double youngs_modulus() const { return youngs_modulus_; }
  /// Equivalent strain.
  double equivalent(const Tensor6& strain) const;
  /// How a crack softens its cell.
  Softening softening(const Crack& crack) const { return {fracture_.softening, crack.ratio}; }
  /// A cell without a crack at this strain: the crack that begins, without damage yet, or nothing.
  std::optional<Crack> onset(const Tensor6& strain, double strength_factor, const Vec3& lead = {}) const;
  /// The crack of unit normal n with this damage, above 0 and at most 1, that uniaxial tension across it would have
  /// made; where the cell would break at once its damage is 1.
  Crack damaged(const Vec3& n, double damage, double strength_factor) const;
  /// Raises the damage of a cracked cell to what this strain asks for; `energy` [J/m^3] is what the intact cell would
  /// store more than its closed faces do, which damage takes.
  void soften(Crack& crack, const Tensor6& strain, double energy) const;
  /// Energy of the intact cell [J/m^3].
  double energy(const Tensor6& strain) const { return elastic_energy(lambda_, mu_, strain); }
  /// Lets the closed faces of the crack slide as far as their friction lets them; the energy [J/m^3] that takes, for a
  /// fully cracked cell.
  double slide_faces(Crack& crack, const Tensor6& strain) const;
  /// What the closed faces of the crack carry; times the damage.
  FaceContact faces(const Crack& crack, const Tensor6& strain) const {
    return face_contact({youngs_modulus_, mu_}, crack.normal, crack.slip, strain);
  }

 private:
  double threshold_of(const Vec3& normal, double strength_factor) const;

  double youngs_modulus_, lambda_, mu_;
  material::Fracture fracture_;
  Criterion criterion_;
  double friction_;
  double d_;
};

}  // namespace koshi::failure
