// What closed crack faces carry: pressure, and Coulomb friction (theory, section 12).
#pragma once

#include "failure/principal.h"

namespace koshi::failure {

/// Elastic part of the faces' law: E and mu [Pa] of the cell.
struct FaceModuli {
  double youngs_modulus, mu;
};

/// How far the faces of normal n (unit) have slid over the cell's width at this strain, which they had slid by `slip`
/// before: closed ones slide by what their friction does not hold, open ones follow the shear. A vector along the
/// crack.
Vec3 slide(const FaceModuli& moduli, double friction, const Vec3& n, const Vec3& slip, const Tensor6& strain);

/// What faces that have slid by `slip` carry; zero where they are open. A cell with damage omega adds omega times
/// these.
struct FaceContact {
  Tensor6 stress{};   ///< [Pa]
  Vec3 shear{};       ///< [Pa], of the stress, along the crack
  double energy = 0;  ///< stored [J/m^3]; the stress is its derivative
};
FaceContact face_contact(const FaceModuli& moduli, const Vec3& n, const Vec3& slip, const Tensor6& strain);

}  // namespace koshi::failure
