// Orientation of nodes: unit quaternions, Euler angles, Euler's equations.
//
// The paper integrates Euler angles and meets their singularity at theta = 0. Here the quaternion is integrated, and
// the angles are only reported.
#pragma once

#include <array>

#include "koshi/vector3.h"

namespace koshi::dynamics {

using Quaternion = std::array<double, 4>;  ///< w, x, y, z; unit length

/// q turned by the angular velocity omega [rad/s, body-independent axes] over dt: exp(omega dt / 2) q, normalised.
Quaternion rotate(const Quaternion& q, const Vec3& omega, double dt);

/// Rotation matrix, rows in space: X = R xi.
std::array<Vec3, 3> matrix(const Quaternion& q);

/// Euler angles (theta, phi, psi) [rad] of Fig. 2: R = Rz(phi) Rx(theta) Rz(psi); theta in [0, pi], phi and psi in
/// (-pi, pi]. At theta = 0 or pi only phi + psi (phi - psi) is defined; psi is 0 there.
Vec3 euler_angles(const Quaternion& q);

/// Angular acceleration in principal axes (N24), I domega/dt = N - omega x (I omega); for a sphere N / I.
Vec3 angular_acceleration(const Vec3& I, const Vec3& N, const Vec3& omega);

}  // namespace koshi::dynamics
