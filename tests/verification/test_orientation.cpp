// Rotation of nodes: quaternions against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dynamics/orientation.h"

namespace koshi {
namespace {

using dynamics::Quaternion;
constexpr double pi = std::numbers::pi;

Quaternion about(const Vec3& axis, double angle) {
  return {std::cos(angle / 2), std::sin(angle / 2) * axis[0], std::sin(angle / 2) * axis[1],
          std::sin(angle / 2) * axis[2]};
}

// A constant angular velocity turns by |omega| t about its axis, however the time is divided; each step
// may round by 1e-16.
TEST(Orientation, TurnsAboutAFixedAxisByTheAngleTravelled) {
  const Vec3 axis{2.0 / 7, -3.0 / 7, 6.0 / 7};
  int checked = 0;
  for (const int steps : {1, 7, 100000})
    for (const double angle : {1e-9, 0.3, 2.5, 40.0}) {
      Quaternion q = about({0, 0, 1}, 0.7);
      const Vec3 omega = (angle / 2.0) * axis;
      for (int s = 0; s < steps; ++s) q = dynamics::rotate(q, omega, 2.0 / steps);
      // Composition of the start with the turn about `axis`: matrices multiply.
      const auto R = dynamics::matrix(about(axis, angle)), R0 = dynamics::matrix(about({0, 0, 1}, 0.7));
      const auto result = dynamics::matrix(q);
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j, ++checked) {
          double expected = 0;
          for (int k = 0; k < 3; ++k) expected += R[i][k] * R0[k][j];
          EXPECT_NEAR(result[i][j], expected, 1e-14 + 1e-16 * steps);
        }
    }
  EXPECT_EQ(checked, 108);
}

// R = Rz(phi) Rx(theta) Rz(psi), by composing quaternions from the angles; theta = 0 and pi leave only one sum defined.
TEST(Orientation, ComesBackFromItsEulerAngles) {
  const auto compose = [](double theta, double phi, double psi) {
    Quaternion q = about({0, 0, 1}, psi);
    q = dynamics::rotate(q, {theta, 0, 0}, 1);
    return dynamics::rotate(q, {0, 0, phi}, 1);
  };
  int checked = 0;
  for (const double theta : {0.0, 1e-13, 1e-6, 0.4, pi / 2, 3.0, pi - 1e-6, pi})
    for (const double phi : {-3.0, -0.2, 0.0, 1.1, pi})
      for (const double psi : {-2.0, 0.0, 0.6, 3.1}) {
        const Quaternion q = compose(theta, phi, psi);
        const Vec3 angles = dynamics::euler_angles(q);
        EXPECT_GE(angles[0], 0);
        EXPECT_LE(angles[0], pi);
        const auto expected = dynamics::matrix(q);
        const auto result = dynamics::matrix(compose(angles[0], angles[1], angles[2]));
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j, ++checked) EXPECT_NEAR(result[i][j], expected[i][j], 1e-9) << theta << ' ' << phi;
        if (theta > 0.1 && theta < 3.1) {
          EXPECT_NEAR(angles[0], theta, 1e-14);
          EXPECT_NEAR(std::remainder(angles[1] - phi, 2 * pi), 0, 1e-13);
          EXPECT_NEAR(std::remainder(angles[2] - psi, 2 * pi), 0, 1e-13);
        }
        if (theta == 0) {
          EXPECT_NEAR(std::remainder(angles[1] - phi - psi, 2 * pi), 0, 1e-13);
          EXPECT_EQ(angles[2], 0);
        }
      }
  EXPECT_EQ(checked, 8 * 5 * 4 * 9);
}

// Euler's equations without torque conserve the energy omega.I omega / 2 and the size of the angular momentum I omega.
// Heun's rule integrates them here with an error of order dt^2.
TEST(Orientation, TorqueFreeAsymmetricBodyKeepsEnergyAndMomentum) {
  const Vec3 I{1, 2, 3.5};
  Vec3 omega{0.1, 1, 0.2};  // near the middle axis, where the motion tumbles
  const auto energy = [&] {
    return 0.5 * (I[0] * omega[0] * omega[0] + I[1] * omega[1] * omega[1] + I[2] * omega[2] * omega[2]);
  };
  const auto momentum = [&] { return norm(Vec3{I[0] * omega[0], I[1] * omega[1], I[2] * omega[2]}); };
  const double E = energy(), L = momentum(), dt = 1e-4;
  double lowest = omega[1];
  for (int step = 0; step < 200'000; ++step) {
    const Vec3 a = dynamics::angular_acceleration(I, {}, omega);
    const Vec3 b = dynamics::angular_acceleration(I, {}, omega + dt * a);
    omega = omega + (0.5 * dt) * (a + b);
    lowest = std::min(lowest, omega[1]);
  }
  EXPECT_NEAR(energy() / E, 1, 1e-7);
  EXPECT_NEAR(momentum() / L, 1, 1e-7);
  EXPECT_LT(lowest, -0.9);  // it did tumble: the gyroscopic terms are at work
}

// A torque along a principal axis: N / I, and a sphere has no gyroscopic terms.
TEST(Orientation, TorqueAcceleratesByTheInertia) {
  const Vec3 a = dynamics::angular_acceleration({2, 4, 5}, {0, 6, 0}, {});
  EXPECT_DOUBLE_EQ(a[1], 1.5);
  EXPECT_EQ(a[0], 0);
  const Vec3 b = dynamics::angular_acceleration({2, 2, 2}, {1, 2, 3}, {5, -4, 7});
  EXPECT_NEAR(b[0], 0.5, 1e-14);
  EXPECT_NEAR(b[1], 1.0, 1e-14);
  EXPECT_NEAR(b[2], 1.5, 1e-14);
  // -omega x (I omega) / I = -(2 x 10.5 - 3 x 4) / 1, -(3 x 1 - 1 x 10.5) / 2, -(1 x 4 - 2 x 1) / 3.5.
  const Vec3 gyroscopic = dynamics::angular_acceleration({1, 2, 3.5}, {}, {1, 2, 3});
  EXPECT_NEAR(gyroscopic[0], -9, 1e-14);
  EXPECT_NEAR(gyroscopic[1], 3.75, 1e-14);
  EXPECT_NEAR(gyroscopic[2], -4.0 / 7, 1e-14);
}

}  // namespace
}  // namespace koshi
