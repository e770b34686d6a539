// When a material cracks: Rankine's tensile cut-off with Mohr and Coulomb's limit (theory, section 12).
#pragma once

#include <algorithm>
#include <cmath>

#include "failure/principal.h"
#include "koshi/fracture.h"

namespace koshi::failure {

/// A bound on an equivalent stress or strain from mean p and radius r of the deviator: max(p_1 p + r_1 r, p_2 p + r_2
/// r).
struct Bound {
  double p_1 = 0, r_1 = 0, p_2 = 0, r_2 = 0;
  double operator()(double p, double r) const { return std::max(p_1 * p + r_1 * r, p_2 * p + r_2 * r); }
  /// The most that the bound can change with the tensor, over the size |A| of the change: |dp| is the spherical part's
  /// size over sqrt(3), |dr| the deviator's times sqrt(2/3).
  double slope() const { return std::sqrt(std::max(p_1 * p_1 + 2 * r_1 * r_1, p_2 * p_2 + 2 * r_2 * r_2) / 3); }
};

class Criterion {
 public:
  explicit Criterion(const material::Fracture& fracture);

  /// Equivalent stress [Pa] max(s1, f_t/f_c (m s1 - s3)) of principal stresses s1 >= s2 >= s3 (tension positive): the
  /// material cracks where it reaches f_t. Negative where nothing pulls or shears.
  double equivalent(const Vec3& stress) const {
    const double tension = stress[0];
    return std::max(tension, ratio_ * (m_ * stress[0] - stress[2]));
  }

  /// Whether it is the shear limit that counts.
  bool shears(const Vec3& stress) const { return ratio_ * (m_ * stress[0] - stress[2]) > stress[0]; }

  /// Unit normal of the plane that cracks: across s1 in tension; in shear the plane on which Mohr and Coulomb's limit
  /// is reached first, its normal at 45 degrees + phi/2 from s3 towards s1.
  Vec3 normal(const Principal& stress) const;

  /// Never below equivalent() of a stress with this mean and radius; needs no principal values.
  Bound bound() const { return {1, 1, ratio_ * (m_ - 1), ratio_ * spread_}; }

 private:
  double ratio_ = 0;  // f_t/f_c, 0 without a shear limit
  double m_ = 1;
  double spread_ = 0;  // sqrt(m^2 + m + 1)
  Vec3 shear_{};       // normal of the shear plane in the frame of principal directions
};

}  // namespace koshi::failure
