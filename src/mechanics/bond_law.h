// The bond law (theory, section 2; Nishimura et al. N10-N16, N23-N25): a pure function of geometry, stiffness and
// relative displacement. It knows no lattice, no rank, no solver; every kernel is checked against it.
#pragma once

#include "koshi/vector3.h"

namespace koshi::mechanics {

/// Relative displacement with the rigid rotation removed, r = u1 - u2 - w x D (N23); D = x1 - x2, w = (w1 + w2)/2
/// (N25).
inline Vec3 relative_displacement(const Vec3& u1, const Vec3& u2, const Vec3& w, const Vec3& D) {
  return u1 - u2 - cross(w, D);
}

/// F = kn r_n + kt r_t [N], r_n the part of r along D; acts as -F on node 1 and +F on node 2.
inline Vec3 bond_force(double kn, double kt, const Vec3& D, const Vec3& r) {
  const Vec3 r_n = (1 / dot(D, D) * dot(r, D)) * D;
  return kn * r_n + kt * (r - r_n);
}

/// M = D x F / 2 [N m] on both nodes, of the lever arm |D|/2 (N24); minus the gradient of bond_energy, with F.
inline Vec3 bond_moment(const Vec3& D, const Vec3& F) { return 0.5 * cross(D, F); }

/// Energy (kn |r_n|^2 + kt |r_t|^2) / 2 [J].
inline double bond_energy(double kn, double kt, const Vec3& D, const Vec3& r) {
  const double normal = dot(r, D) / norm(D);
  return 0.5 * (kn * normal * normal + kt * (dot(r, r) - normal * normal));
}

}  // namespace koshi::mechanics
