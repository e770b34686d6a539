// Two solids in one cell: what the mixture of chapter 14 promises.
#include "material/mixture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "koshi/vector3.h"

namespace koshi::material {
namespace {

Elastic of(double K, double G, double density = 2000) {
  return {9 * K * G / (3 * K + G), (3 * K - 2 * G) / (2 * (3 * K + G)), density};
}
double bulk(const Elastic& e) { return e.lambda() + 2 * e.mu() / 3; }

using Matrix = std::array<Vec3, 3>;

// Stored energy less the work of the traction on the stretch across the interface, which is the one that the traction
// asks for: strain e + sym(a n), sigma n = t. What layers and the solid that stands for them must have alike.
double mixed_energy(const Elastic& solid, const Matrix& e, const Vec3& t, const Vec3& n) {
  const double lambda = solid.lambda(), G = solid.mu();
  const double trace = e[0][0] + e[1][1] + e[2][2];
  Vec3 lacking{};
  for (std::size_t i = 0; i < 3; ++i) lacking[i] = t[i] - lambda * trace * n[i] - 2 * G * dot(e[i], n);
  const double across = dot(lacking, n);
  Vec3 a{};
  for (std::size_t i = 0; i < 3; ++i) a[i] = across * n[i] / (lambda + 2 * G) + (lacking[i] - across * n[i]) / G;
  double square = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) square += std::pow(e[i][j] + (a[i] * n[j] + a[j] * n[i]) / 2, 2);
  return lambda / 2 * std::pow(trace + dot(a, n), 2) + G * square - dot(t, a);
}

// Lebedev's 26 directions: exact up to the seventh power of n.
template <class F>
double mean_over_directions(F&& f) {
  double sum = 0, weights = 0;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z) {
        const int length = x * x + y * y + z * z;
        if (length == 0) continue;
        const double weight = length == 1 ? 1.0 / 21 : length == 2 ? 4.0 / 105 : 27.0 / 840, r = std::sqrt(length);
        sum += weight * f(Vec3{x / r, y / r, z / r});
        weights += weight;
      }
  EXPECT_NEAR(weights, 1, 1e-14);
  return sum;
}

// The derivation, by numbers: with the even and the uneven strain of a ball of the inclusion the mixture has, over all
// directions of the interface, the energy of the two solids.
TEST(Mixture, HasTheEnergyOfLayersAroundABall) {
  const Matrix even{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, uneven{{{1, 0.3, 0}, {0.3, -0.4, 0.2}, {0, 0.2, -0.6}}};
  int compared = 0;
  for (const Elastic& inclusion : {of(370e9, 440e9), of(9e9, 2e9), of(60e9, 20e9)})
    for (const double share : {0.125, 0.5, 0.8125})
      for (const Matrix& e : {even, uneven}) {
        const Elastic matrix = of(37e9, 44e9), mixed = mixture(matrix, inclusion, share, inclusion);
        const double trace = e[0][0] + e[1][1] + e[2][2];
        const auto energy = [&](const Elastic& solid) {
          return mean_over_directions([&](const Vec3& n) {
            Vec3 t{};
            for (std::size_t i = 0; i < 3; ++i)
              t[i] = inclusion.lambda() * trace * n[i] + 2 * inclusion.mu() * dot(e[i], n);
            return mixed_energy(solid, e, t, n);
          });
        };
        const double layers = (1 - share) * energy(matrix) + share * energy(inclusion);
        const double apart = std::abs(energy(matrix) - energy(inclusion));
        EXPECT_GT(apart, 1e9);
        EXPECT_NEAR(energy(mixed), layers, 1e-10 * apart);
        ++compared;
      }
  EXPECT_EQ(compared, 18);
}

TEST(Mixture, EqualShearModuliGiveHillsMean) {
  const double G = 20e9, c = 0.3, M = 1 / ((1 - c) / (10e9 + 4 * G / 3) + c / (90e9 + 4 * G / 3));
  const Elastic mixed = mixture(of(10e9, G, 1000), of(90e9, G, 3000), c, of(30e9, G));
  EXPECT_NEAR(mixed.mu() / G, 1, 1e-12);
  EXPECT_NEAR(bulk(mixed) / (M - 4 * G / 3), 1, 1e-12);
  EXPECT_DOUBLE_EQ(mixed.density, 1600);
}

TEST(Mixture, AloneEachSolidIsItself) {
  const Elastic a = of(37e9, 44e9, 2650), b = of(8e9, 3e9, 1500);
  for (const double share : {0.0, 1.0}) {
    const Elastic mixed = mixture(a, b, share, b), &one = share == 0 ? a : b;
    EXPECT_NEAR(mixed.mu() / one.mu(), 1, 1e-12);
    EXPECT_NEAR(bulk(mixed) / bulk(one), 1, 1e-12);
    EXPECT_DOUBLE_EQ(mixed.density, one.density);
  }
}

// An inclusion without stiffness leaves the share of the matrix as a factor, as voids do; a rigid one divides the shear
// modulus by it.
TEST(Mixture, VoidsAndRigidInclusions) {
  const Elastic matrix = of(37e9, 44e9), soft = mixture(matrix, of(37, 44), 0.25, of(37, 44)),
                hard = mixture(matrix, of(37e18, 44e18), 0.25, of(37e18, 44e18));
  EXPECT_NEAR(soft.mu() / 44e9, 0.75, 1e-7);
  EXPECT_NEAR(bulk(soft) / 37e9, 0.75, 1e-7);
  EXPECT_NEAR(hard.mu() / (44e9 / 0.75), 1, 1e-7);
}

// Whatever the contrast, no mixture is softer than the harmonic mean or stiffer than the volume mean.
TEST(Mixture, StaysBetweenTheMeans) {
  int compared = 0, at_a_bound = 0;
  for (const double ratio : {1e-3, 0.1, 3.0, 500.0})
    for (const double nu : {-0.2, 0.1, 0.45})
      for (const double c : {0.0625, 0.5, 0.875}) {
        const Elastic matrix{50e9, 0.2, 2000}, inclusion{ratio * 50e9, nu, 2000};
        const Elastic mixed = mixture(matrix, inclusion, c, inclusion);
        for (const auto modulus :
             {+[](const Elastic& e) { return e.mu(); }, +[](const Elastic& e) { return bulk(e); }}) {
          const double a = modulus(matrix), b = modulus(inclusion), found = modulus(mixed);
          const double least = 1 / ((1 - c) / a + c / b), most = (1 - c) * a + c * b;
          EXPECT_GE(found, least * (1 - 1e-9)) << ratio << ' ' << nu << ' ' << c;
          EXPECT_LE(found, most * (1 + 1e-9)) << ratio << ' ' << nu << ' ' << c;
          at_a_bound += std::abs(found / least - 1) < 1e-9 || std::abs(found / most - 1) < 1e-9;
          ++compared;
        }
      }
  EXPECT_EQ(compared, 72);
  EXPECT_LT(at_a_bound, 36);
}

// Between a stiff ball in soft and a soft one in stiff: where neither is the inclusion both may be, the mean of their
// moduli by ratio.
TEST(Mixture, AnInclusionOfBothLiesBetween) {
  const Elastic a = of(37e9, 44e9, 1000), b = of(370e9, 440e9, 4000), both = geometric_mean(a, b, 0.5);
  EXPECT_NEAR(bulk(both) / (std::sqrt(10) * 37e9), 1, 1e-12);
  EXPECT_NEAR(both.mu() / (std::sqrt(10) * 44e9), 1, 1e-12);
  EXPECT_NEAR(geometric_mean(a, b, 0).mu() / 44e9, 1, 1e-12);
  const double stiff = mixture(a, b, 0.5, b).mu(), middle = mixture(a, b, 0.5, both).mu(),
               soft = mixture(a, b, 0.5, a).mu();
  EXPECT_LT(1.3 * stiff, middle);
  EXPECT_LT(1.3 * middle, soft);
  // Which of the two stands first counts nothing.
  EXPECT_NEAR(mixture(b, a, 0.5, both).mu() / middle, 1, 1e-12);
}

}  // namespace
}  // namespace koshi::material
