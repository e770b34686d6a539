#include "dynamics/orientation.h"

#include <cmath>

namespace koshi::dynamics {

Quaternion rotate(const Quaternion& q, const Vec3& omega, double dt) {
  const double angle = norm(omega) * dt;
  // sin(a/2)/a tends to 1/2; below 1e-4 its series is exact to rounding.
  const double scale = angle > 1e-4 ? std::sin(0.5 * angle) / angle : 0.5 - angle * angle / 48;
  const double c = std::cos(0.5 * angle);
  const Vec3 v = scale * dt * omega;
  const Vec3 qv{q[1], q[2], q[3]};
  const Vec3 rv = c * qv + q[0] * v + cross(v, qv);
  Quaternion r{c * q[0] - dot(v, qv), rv[0], rv[1], rv[2]};
  const double length = std::sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2] + r[3] * r[3]);
  for (double& x : r) x /= length;
  return r;
}

std::array<Vec3, 3> matrix(const Quaternion& q) {
  const auto [w, x, y, z] = q;
  return {{{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
           {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
           {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}}};
}

Vec3 euler_angles(const Quaternion& q) {
  const auto R = matrix(q);
  // The third column is (sin theta sin phi, -sin theta cos phi, cos theta).
  const double sine = std::hypot(R[0][2], R[1][2]);
  const double theta = std::atan2(sine, R[2][2]);
  if (sine < 1e-12) return {theta, std::atan2(R[1][0], R[0][0]), 0};
  return {theta, std::atan2(R[0][2], -R[1][2]), std::atan2(R[2][0], R[2][1])};
}

Vec3 angular_acceleration(const Vec3& I, const Vec3& N, const Vec3& omega) {
  const Vec3 momentum{I[0] * omega[0], I[1] * omega[1], I[2] * omega[2]};
  const Vec3 torque = N - cross(omega, momentum);
  return {torque[0] / I[0], torque[1] / I[1], torque[2] / I[2]};
}

}  // namespace koshi::dynamics
