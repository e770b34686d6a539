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
      const double exact = criterion.equivalent(principal(stress).value), bound = criterion.bound(stress);
      EXPECT_GE(bound, exact - 1e-8);
      if (exact > 0) closest = std::min(closest, bound / exact);
    }
    EXPECT_NEAR(criterion.bound(outer(8e6, {0, 1, 0})) / 8e6, 1, 1e-12);
  }
  EXPECT_LT(closest, 1.001);
}

// Work of the stress sigma = (1 - omega) E kappa up to full opening, by Simpson's rule on each smooth part: exact for
// the line (stress is linear in kappa), and to 1e-11 for the exponential cut at 40 decay lengths (e^-40).
TEST(Softening, TakesTheFractureEnergy) {
  using material::Softening;
  const double E = 30e9, ft = 3e6, Gf = 100;
  for (const double h : {1e-3, 1e-2, 0.3, 0.59}) {
    const double e0 = ft / E;
    ASSERT_LT(h, width_limit(E, ft, Gf));
    for (const Softening kind : {Softening::linear, Softening::exponential}) {
      const failure::Softening law(kind, E, ft, Gf, h);
      const double end = kind == Softening::linear ? 2 * Gf / h / ft : e0 + 40 * (Gf / h / ft - e0 / 2);
      const int steps = 20000;
      double work = 0.5 * E * e0 * e0;
      const double step = (end - e0) / steps;
      for (int s = 0; s <= steps; ++s) {
        const double kappa = e0 + s * step, weight = s == 0 || s == steps ? 1 : s % 2 == 1 ? 4 : 2;
        work += weight * step / 3 * (1 - law.damage(kappa)) * E * kappa;
      }
      EXPECT_NEAR(work / (Gf / h), 1, 1e-10) << h;
      EXPECT_NEAR(law.dissipated(end) / (Gf / h), 1, 1e-10) << h;
      EXPECT_NEAR(law.damage(end), 1, 1e-10);
      EXPECT_EQ(law.threshold(), e0);
      EXPECT_EQ(law.damage(e0), 0);
    }
  }
}

// d(dissipated)/d(kappa) = 1/2 E kappa^2 d(omega)/d(kappa): the elastic energy that lost springs held.
TEST(Softening, DissipationIsTheEnergyOfLostSprings) {
  using material::Softening;
  for (const Softening kind : {Softening::linear, Softening::exponential}) {
    const failure::Softening law(kind, 30e9, 3e6, 100, 0.1);
    double last = 0;
    for (double kappa = 1.05e-4; kappa < 6e-4; kappa += 1e-5) {
      const double step = 1e-9;
      const double lost = (law.damage(kappa + step) - law.damage(kappa - step)) * 0.5 * 30e9 * kappa * kappa;
      EXPECT_NEAR((law.dissipated(kappa + step) - law.dissipated(kappa - step)) / lost, 1, 1e-5);
      EXPECT_GT(law.damage(kappa), last);
      last = law.damage(kappa);
    }
  }
}

// Too wide a band: strength sqrt(2 E G_f/h), so that the elastic energy at the limit is G_f/h, gone at once.
TEST(Softening, CoarseBandKeepsTheFractureEnergy) {
  const double E = 30e9, ft = 3e6, Gf = 100, limit = width_limit(E, ft, Gf);
  EXPECT_NEAR(limit, 2 * E * Gf / (ft * ft), 1e-12);
  for (const double h : {limit, 2 * limit, 10 * limit}) {
    const Softening law(material::Softening::linear, E, ft, Gf, h);
    EXPECT_NEAR(law.threshold() * E / ft, std::sqrt(limit / h), 1e-14);
    EXPECT_EQ(law.damage(law.threshold()), 0);
    EXPECT_EQ(law.damage(law.threshold() * (1 + 1e-12)), 1);
    EXPECT_NEAR(law.dissipated(law.threshold() * 1.01) * h / Gf, 1, 1e-14);
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
