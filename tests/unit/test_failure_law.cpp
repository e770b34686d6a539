// The parts of the law of cracking cells (theory, section 12): principal values, criterion, softening.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "failure/criterion.h"
#include "failure/softening.h"

namespace koshi::failure {
namespace {

constexpr double degrees = std::numbers::pi / 180;

Tensor6 outer(double value, const Vec3& n) {
  return {value * n[0] * n[0], value * n[1] * n[1], value * n[2] * n[2],
          value * n[1] * n[2], value * n[0] * n[2], value * n[0] * n[1]};
}

Tensor6 plus(Tensor6 a, const Tensor6& b) {
  for (std::size_t v = 0; v < 6; ++v) a[v] += b[v];
  return a;
}

Vec3 unit(const Vec3& v) { return (1 / norm(v)) * v; }

Tensor6 random_tensor(std::mt19937_64& random, double scale) {
  std::normal_distribution<double> value(0, scale);
  Tensor6 t;
  for (double& v : t) v = value(random);
  return t;
}

double bound_of(const Criterion& criterion, const Tensor6& stress) {
  const MeanRadius at = mean_radius(stress);
  return criterion.bound()(at.mean, at.radius);
}

// Granite-like: f_t, c, phi such that the cut-off is below Mohr and Coulomb's uniaxial strength f_c/m.
material::Fracture granite() {
  material::Fracture fracture;
  fracture.tensile_strength = 8e6;
  fracture.fracture_energy = 100;
  fracture.cohesion = 30e6;
  fracture.friction_angle = 45 * degrees;
  return fracture;
}

// sum value n x n gives the tensor back, the directions are orthonormal, the values descend.
TEST(Principal, DecomposesAnyTensor) {
  std::mt19937_64 random(1);
  std::vector<Tensor6> tensors{{}, {1, 1, 1, 0, 0, 0}, {3, 2, 2, 0, 0, 0}, {0, 0, 0, 1, 0, 0}};
  for (int repeat = 0; repeat < 200; ++repeat) tensors.push_back(random_tensor(random, 1));
  for (const Tensor6& t : tensors) {
    const Principal p = principal(t);
    Tensor6 sum{};
    for (std::size_t a = 0; a < 3; ++a) {
      sum = plus(sum, outer(p.value[a], p.direction[a]));
      EXPECT_NEAR(along(t, p.direction[a]), p.value[a], 1e-14);
      for (std::size_t b = 0; b < 3; ++b) EXPECT_NEAR(dot(p.direction[a], p.direction[b]), a == b ? 1 : 0, 1e-14);
    }
    for (std::size_t v = 0; v < 6; ++v) EXPECT_NEAR(sum[v], t[v], 5e-14);
    EXPECT_GE(p.value[0], p.value[1]);
    EXPECT_GE(p.value[1], p.value[2]);
  }
}

// Tension f_t along any direction reaches the limit, and cracks the plane across it.
TEST(Criterion, TensileStrengthHasNoDirection) {
  const Criterion criterion(granite());
  for (const Vec3& v : {Vec3{1, 0, 0}, Vec3{1, 1, 0}, Vec3{1, 1, 1}, Vec3{3, 2, 1}, Vec3{-1, 5, 2}}) {
    const Vec3 n = unit(v);
    const Principal p = principal(outer(8e6, n));
    EXPECT_NEAR(criterion.equivalent(p.value) / 8e6, 1, 1e-14);
    EXPECT_NEAR(std::abs(dot(criterion.normal(p), n)), 1, 1e-14);
  }
}

// Mohr and Coulomb: with confinement p a column carries f_c + m p, m = tan^2(45 + phi/2), and f_c = 2 c sqrt(m). On the
// plane that cracks the shear stress is c + pressure tan(phi); on no other plane is it more.
TEST(Criterion, ConfinedCompression) {
  const material::Fracture fracture = granite();
  const Criterion criterion(fracture);
  const double tangent = std::tan((45 + 45.0 / 2) * degrees), m = tangent * tangent;
  int planes = 0;
  for (const double p : {0.0, 5e6, 20e6})
    for (const Vec3& v : {Vec3{1, 0, 0}, Vec3{1, 1, 1}, Vec3{3, 2, 1}}) {
      const double strength = 2 * 30e6 * std::sqrt(m) + m * p;
      const Tensor6 stress = plus(outer(p - strength, unit(v)), {-p, -p, -p, 0, 0, 0});
      const Principal found = principal(stress);
      EXPECT_NEAR(criterion.equivalent(found.value) / 8e6, 1, 1e-12);
      const auto excess = [&](const Vec3& n) {
        const Vec3 t = times(stress, n);
        const double pressure = -dot(t, n);
        return norm(t + pressure * n) - pressure * std::tan(45 * degrees) - 30e6;
      };
      EXPECT_NEAR(excess(criterion.normal(found)) / 30e6, 0, 1e-12);
      std::mt19937_64 random(2);
      for (int repeat = 0; repeat < 500; ++repeat, ++planes) {
        const Tensor6 r = random_tensor(random, 1);
        EXPECT_LE(excess(unit({r[0], r[1], r[2]})) / 30e6, 1e-12);
      }
    }
  EXPECT_EQ(planes, 4500);
}

// The bound holds for every stress, and is reached: in uniaxial tension s1 = p + r exactly.
TEST(Criterion, BoundIsAboveAndTight) {
  std::mt19937_64 random(3);
  material::Fracture tension = granite();
  tension.cohesion.reset();
  double closest = 10;
  for (const material::Fracture& fracture : {granite(), tension}) {
    const Criterion criterion(fracture);
    for (int repeat = 0; repeat < 2000; ++repeat) {
      const Tensor6 stress = random_tensor(random, 1e7);
      const double exact = criterion.equivalent(principal(stress).value), bound = bound_of(criterion, stress);
      EXPECT_GE(bound, exact - 1e-8);
      if (exact > 0) closest = std::min(closest, bound / exact);
    }
    EXPECT_NEAR(bound_of(criterion, outer(8e6, {0, 1, 0})) / 8e6, 1, 1e-12);
  }
  EXPECT_LT(closest, 1.001);
}

// Uniaxial tension, elastic energy x^2 at x times the strain of the onset, damage by damage: the crack takes `ratio` in
// all, in units of the energy at the onset, but for the end of the last step.
TEST(Softening, TakesTheFractureEnergy) {
  int laws = 0;
  for (const double ratio : {1.02, 2.0, 7.5, 300.0})
    for (const double step : {1e-3, 0.02})
      for (const auto kind : {material::Softening::linear, material::Softening::exponential}) {
        const Softening law(kind, ratio);
        double damage = 0, taken = 0;
        double next_x = 1;
        for (double x = 1; x < 20 * ratio; x = next_x) {
          next_x = x * (1 + step);
          const double energy = x * next_x, next = law.damage(damage, taken, next_x, energy);
          EXPECT_GE(next, damage);
          taken += (next - damage) * energy;
          damage = next;
        }
        const bool at_once = ratio < 1 + 2 * step;  // the step is more than the crack takes
        EXPECT_NEAR(taken / ratio, 1, at_once ? 0.05 : 0.02 * step) << ratio << ' ' << step;
        EXPECT_NEAR(damage, 1, 1e-10);
        ++laws;
      }
  EXPECT_EQ(laws, 16);
}

// In small steps the stress (1 - omega) x falls on the line to x = ratio, or as exp(-2 (x - 1)/(ratio - 1)), whose area
// from the onset on is (ratio - 1)/2: with the triangle before, 1/2, it is ratio/2.
TEST(Softening, StressFallsAsAsked) {
  const double ratio = 8, step = 1e-3;
  for (const auto kind : {material::Softening::linear, material::Softening::exponential}) {
    const Softening law(kind, ratio);
    double damage = 0, taken = 0, farthest = 0;
    for (double x = 1; x < 2 * ratio; x += step) {
      const double energy = x * (x + step), next = law.damage(damage, taken, x + step, energy), to = x + step;
      taken += (next - damage) * energy;
      damage = next;
      const double asked = kind == material::Softening::linear ? std::max(0.0, (ratio - to) / (ratio - 1))
                                                               : std::exp(-2 * (to - 1) / (ratio - 1));
      farthest = std::max(farthest, std::abs((1 - damage) * to - asked));
    }
    EXPECT_LT(farthest, 1e-6);
    EXPECT_GT(taken, 0.9 * ratio);
  }
}

// Where the sides of a cell are held its stress and energy rise faster, here by 1.11; the stress falls from the onset
// on all the same, and the crack takes what it should.
TEST(Softening, HeldSidesChangeNothing) {
  for (const auto kind : {material::Softening::linear, material::Softening::exponential}) {
    const Softening law(kind, 140);
    double damage = 0, taken = 0, last = 1;
    for (double x = 1; x < 3000; x += 0.1) {
      // Stress 1 + 1.11 (x - 1); energy twice the area under it.
      const double to = x + 0.1, stress = 1 + 1.11 * (to - 1);
      const double energy = 1 + 2 * (to - 1) + 1.11 * (to - 1) * (to - 1);
      const double next = law.damage(damage, taken, stress, energy);
      taken += (next - damage) * energy;
      damage = next;
      EXPECT_LE((1 - damage) * stress, last + 1e-12);
      last = (1 - damage) * stress;
    }
    EXPECT_NEAR(taken / 140, 1, 1e-7);
  }
}

// Too wide a band: strength sqrt(2 E G_f/h), so that the elastic energy at the limit is G_f/h, gone at once.
TEST(Softening, CoarseBandKeepsTheFractureEnergy) {
  const double E = 30e9, ft = 3e6, Gf = 100, limit = width_limit(E, ft, Gf);
  EXPECT_NEAR(limit, 2 * E * Gf / (ft * ft), 1e-12);
  EXPECT_EQ(threshold(E, ft, Gf, 0.99 * limit), ft / E);
  for (const double h : {limit, 2 * limit, 10 * limit}) {
    const double e = threshold(E, ft, Gf, h);
    EXPECT_NEAR(e * E / ft, std::sqrt(limit / h), 1e-14);
    const Softening law(material::Softening::linear, Gf / h / (0.5 * E * e * e));
    EXPECT_NEAR(law.taken(0) * 0.5 * E * e * e * h / Gf, 1, 1e-14);
    EXPECT_EQ(law.damage(0, 0, 1, 1), 0);
    EXPECT_NEAR(law.damage(0, 0, 1 + 1e-9, 1 + 2e-9), 1, 1e-5);
  }
}

// Cells cut by a plane, counted in a block of 60^3 cells, over the plane's area in it.
TEST(Softening, BandWidthCountsCells) {
  EXPECT_DOUBLE_EQ(band_width(0.5, {0, -1, 0}), 0.5);
  for (const Vec3& v : {Vec3{1, 0.3137, 0.2071}, Vec3{1, 0.9103, 0.5017}}) {
    const Vec3 n = unit(v);
    // Columns along x that stay inside: n.x = c crosses each square of a column's section once.
    const int size = 60;
    std::int64_t cells = 0;
    for (int j = 0; j < size; ++j)
      for (int k = 0; k < size; ++k) {
        // x of the plane at the column's corners; the column's cells between the lowest and the highest are cut.
        const auto x = [&](double y, double z) { return 1000 - (n[1] * y + n[2] * z) / n[0]; };
        const double lo = x(j + 1, k + 1), hi = x(j, k);
        cells += static_cast<std::int64_t>(std::ceil(hi) - std::floor(lo));
      }
    // Area of the plane over the section is 1/n1 of it; a cell has volume 1.
    EXPECT_NEAR(static_cast<double>(cells) * n[0] / (size * size), band_width(1, n), 0.02);
  }
}

}  // namespace
}  // namespace koshi::failure
