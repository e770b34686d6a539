// A cell that cracks, closes and slides (theory, section 12): energies, limits, irreversibility.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "failure/cell_law.h"

namespace koshi::failure {
namespace {

constexpr double degrees = std::numbers::pi / 180;
const material::Elastic concrete{30e9, 0.2, 2400};
const FaceModuli moduli{30e9, concrete.mu()};

material::Fracture brittle(material::Softening softening = material::Softening::exponential) {
  material::Fracture fracture;
  fracture.tensile_strength = 3e6;
  fracture.fracture_energy = 100;
  fracture.cohesion = 8e6;
  fracture.friction_angle = 40 * degrees;
  fracture.residual_friction_angle = 30 * degrees;
  fracture.softening = softening;
  return fracture;
}

double contract(const Tensor6& a, const Tensor6& b) {
  double sum = 0;
  for (std::size_t v = 0; v < 6; ++v) sum += (v < 3 ? 1 : 2) * a[v] * b[v];
  return sum;
}

Tensor6 stress_of(const Tensor6& strain) { return elastic_stress(concrete.lambda(), concrete.mu(), strain); }

// Strain of uniaxial stress E e along n.
Tensor6 uniaxial(double e, const Vec3& n, double nu) {
  Tensor6 strain;
  constexpr std::array<std::array<std::size_t, 2>, 6> pairs{{{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}};
  for (std::size_t v = 0; v < 6; ++v) strain[v] = (1 + nu) * e * n[pairs[v][0]] * n[pairs[v][1]] - (v < 3 ? nu * e : 0);
  return strain;
}

Vec3 unit(const Vec3& v) { return (1 / norm(v)) * v; }

Tensor6 random_strain(std::mt19937_64& random, double scale) {
  std::normal_distribution<double> value(0, scale);
  Tensor6 t;
  for (double& v : t) v = value(random);
  return t;
}

double bound_of(const CellLaw& law, const Tensor6& strain) {
  const MeanRadius at = mean_radius(strain);
  return law.bound()(at.mean, at.radius);
}

void crack_at(const CellLaw& law, std::optional<Crack>& crack, const Tensor6& strain, double energy) {
  if (!crack) crack = law.onset(strain, 1);
  if (crack) law.soften(*crack, strain, energy);
}

// A cell pulled apart along n takes G_f/h(n) per volume, whether its sides are free (uniaxial stress), held from the
// onset on, as in a band between intact cells, or held from the start: the sum of 1/2 sigma:eps times each loss of
// stiffness, but for the end of the last step. Its strength is f_t in every direction.
TEST(CellLaw, TakesTheFractureEnergyInEveryDirection) {
  const double d = 0.01, nu = concrete.poissons_ratio;
  int cells = 0;
  for (const auto softening : {material::Softening::linear, material::Softening::exponential})
    for (const Vec3& v : {Vec3{1, 0, 0}, Vec3{1, 1, 0}, Vec3{1, 1, 1}, Vec3{3, 2, 1}, Vec3{-1, 5, 2}})
      for (const double sides_free_up_to : {1.0, 1e-4, 0.0}) {
        const CellLaw law(concrete, brittle(softening), d);
        const Vec3 n = unit(v);
        std::optional<Crack> crack;
        double taken = 0, peak = 0, damage = 0;
        for (int step = 1; step <= 8000; ++step) {
          const double e = 0.1 * std::pow(step / 8000.0, 3), free = std::min(e, sides_free_up_to);
          Tensor6 strain = uniaxial(free, n, nu);
          for (std::size_t c = 0; c < 6; ++c) strain[c] += uniaxial(e - free, n, 0)[c];
          const double energy = 0.5 * contract(strain, stress_of(strain));
          EXPECT_NEAR(law.energy(strain), energy, 1e-12 * energy);
          crack_at(law, crack, strain, energy);
          const double now = crack ? crack->damage : 0;
          taken += (now - damage) * energy;
          peak = std::max(peak, (1 - now) * along(stress_of(strain), n));
          damage = now;
        }
        EXPECT_NEAR(peak / 3e6, 1, 0.01);
        EXPECT_NEAR(taken * band_width(d, n) / 100, 1, 1e-6);
        EXPECT_NEAR(std::abs(dot(crack->normal, n)), 1, 1e-10);
        ++cells;
      }
  EXPECT_EQ(cells, 30);
}

// Cells stronger by a factor crack at that stress; no cell cracks where the bound is below safe().
TEST(CellLaw, StrengthFactorAndSafeBound) {
  std::mt19937_64 random(4);
  for (const double d : {0.01, 0.5, 3.0}) {  // the coarser ones beyond the limit 2 E G_f/f_t^2 = 0.667 m
    const CellLaw law(concrete, brittle(), d);
    int cracked = 0, safe = 0;
    for (int repeat = 0; repeat < 3000; ++repeat) {
      const Tensor6 strain = random_strain(random, 3e-5);
      const double factor = 0.5 + repeat % 5 * 0.25;
      const bool cracks = law.onset(strain, factor).has_value();
      EXPECT_FALSE(cracks && bound_of(law, strain) <= law.safe(factor));
      cracked += cracks ? 1 : 0;
      safe += bound_of(law, strain) <= law.safe(factor) ? 1 : 0;
    }
    EXPECT_GT(cracked, 100);
    EXPECT_GT(safe, 100);
  }
  const CellLaw law(concrete, brittle(), 0.01);
  EXPECT_FALSE(law.onset(uniaxial(1.4e-4 * (1 - 1e-9), {1, 0, 0}, 0.2), 1.4).has_value());
  EXPECT_TRUE(law.onset(uniaxial(1.4e-4 * (1 + 1e-9), {1, 0, 0}, 0.2), 1.4).has_value());
}

// Damage never falls, whatever the path, and its crack keeps its plane.
TEST(CellLaw, Irreversible) {
  std::mt19937_64 random(5);
  const CellLaw law(concrete, brittle(), 0.01);
  Crack crack = *law.onset(uniaxial(1.5e-4, {1, 0, 0}, 0.2), 1);
  EXPECT_EQ(crack.damage, 0);
  const Vec3 normal = crack.normal;
  int grown = 0;
  for (int repeat = 0; repeat < 1000; ++repeat) {
    const Crack before = crack;
    const Tensor6 strain = random_strain(random, 1e-6 * repeat);
    law.soften(crack, strain, law.energy(strain));
    EXPECT_GE(crack.damage, before.damage);
    EXPECT_GE(crack.kappa, before.kappa);
    grown += crack.damage > before.damage ? 1 : 0;
  }
  EXPECT_EQ(crack.normal, normal);
  EXPECT_GT(grown, 5);
  EXPECT_LE(crack.damage, 1);
}

// Closed faces in uniaxial compression across the crack carry what the intact cell does, E e; open ones nothing.
TEST(CrackFaces, CarryPressureAsIntact) {
  const Vec3 n = unit({1, 2, 3});
  const FaceContact closed = face_contact(moduli, n, {}, uniaxial(-1e-4, n, 0.2));
  EXPECT_NEAR(along(closed.stress, n), -3e6, 1e-6);
  EXPECT_NEAR(std::sqrt(square(closed.stress)), 3e6, 1e-6);
  EXPECT_NEAR(closed.energy, 0.5 * 30e9 * 1e-8, 1e-6);
  const FaceContact open = face_contact(moduli, n, {}, uniaxial(1e-4, n, 0.2));
  EXPECT_EQ(square(open.stress), 0);
  EXPECT_EQ(open.energy, 0);
}

// Nowhere are closed faces stiffer than the intact cell: their energy is below 1/2 eps:C:eps, so that damage takes
// energy and the stable step stays; E is the largest modulus for which that is so (equality in uniaxial stress).
TEST(CrackFaces, NeverStifferThanIntact) {
  std::mt19937_64 random(6);
  double closest = 0;
  for (int repeat = 0; repeat < 5000; ++repeat) {
    const Tensor6 r = random_strain(random, 1);
    const Vec3 n = unit({r[0], r[1], r[2]});
    Tensor6 strain = random_strain(random, 1e-4);
    if (repeat % 2 == 0) strain = uniaxial(-1e-4, n, 0.2);
    if (repeat % 4 == 0) strain[3] += 1e-5;
    const double intact = 0.5 * contract(strain, stress_of(strain));
    const double faces = face_contact(moduli, n, {}, strain).energy;
    EXPECT_LE(faces, intact * (1 + 1e-12));
    closest = std::max(closest, faces / intact);
  }
  EXPECT_NEAR(closest, 1, 1e-12);
}

// While faces stick, stress is the derivative of the energy (central differences; energy is quadratic: to rounding).
TEST(CrackFaces, StressIsTheGradient) {
  std::mt19937_64 random(7);
  int checked = 0;
  for (int repeat = 0; repeat < 300; ++repeat) {
    const Vec3 n = unit({1.0 + repeat % 3, 2, -1.0 * (repeat % 2)});
    Tensor6 strain = random_strain(random, 1e-4);
    for (std::size_t v = 0; v < 3; ++v) strain[v] -= 2e-4;
    const Vec3 slip = 1e-5 * cross(n, {0, 0, 1});
    const auto energy = [&](const Tensor6& e) { return face_contact(moduli, n, slip, e).energy; };
    if (along(strain, n) > -1e-5) continue;
    const FaceContact faces = face_contact(moduli, n, slip, strain);
    for (std::size_t v = 0; v < 6; ++v) {
      Tensor6 plus = strain, minus = strain;
      plus[v] += 1e-6;
      minus[v] -= 1e-6;
      const double slope = (energy(plus) - energy(minus)) / 2e-6;
      EXPECT_NEAR(slope, (v < 3 ? 1 : 2) * faces.stress[v], 1e-3) << v;
      ++checked;
    }
  }
  EXPECT_GT(checked, 1000);
}

// Under pressure p the faces carry at most f p of shear, slide from there on, and the work of a closed cycle of sliding
// is what friction took: 4 times the amplitude beyond sticking, times f p.
TEST(CrackFaces, CoulombFriction) {
  const double mu = concrete.mu(), f = 0.6, press = -1e-4, p = 30e9 * 1e-4;
  const Vec3 n{0, 0, 1};
  Vec3 slip{};
  double heat = 0, work = 0, last = 0, largest = 0, sheared = 0;
  const double amplitude = 3e-4;
  const int steps = 4000;
  for (int step = 1; step <= 5 * steps / 4; ++step) {
    const double gamma = amplitude * std::sin(2 * std::numbers::pi * step / steps);
    const Tensor6 strain{0, 0, press, 0, gamma / 2, 0};
    const Vec3 before = slip;
    slip = slide(moduli, f, n, slip, strain);
    const FaceContact faces = face_contact(moduli, n, slip, strain);
    largest = std::max(largest, std::abs(faces.stress[4]));
    if (step > steps / 4) {
      heat += dot(faces.shear, slip - before);
      work += 0.5 * (faces.stress[4] + last) * (gamma - sheared);
    }
    last = faces.stress[4];
    sheared = gamma;
  }
  EXPECT_NEAR(largest / (f * p), 1, 1e-12);
  const double expected = 4 * (amplitude - f * p / mu) * f * p;
  EXPECT_NEAR(work / expected, 1, 1e-3);
  EXPECT_NEAR(heat / expected, 1, 1e-3);
}

// Along a path that cracks, opens, closes, slides and opens again, work = stored energy + dissipation: the energy that
// lost springs held beyond what the faces took over, and friction.
TEST(CellLaw, WorkIsStoredOrDissipated) {
  const CellLaw law(concrete, brittle(), 0.05);
  std::optional<Crack> crack;
  Tensor6 strain{}, stress{};
  double work = 0, dissipated = 0, friction = 0, stored = 0;
  const int steps = 200000;
  for (int step = 1; step <= steps; ++step) {
    const double t = static_cast<double>(step) / steps;
    // Opens to 3 e-4, closes to -3 e-4 while shearing to and fro, opens again.
    const double open = 3e-4 * std::sin(3 * std::numbers::pi * t), shear = 4e-4 * std::sin(8 * std::numbers::pi * t);
    const Tensor6 next{open, -0.1 * open, 2e-5 * t, 0, 1e-5 * t, 0.5 * shear * t};
    const double damage = crack ? crack->damage : 0;
    FaceContact held;
    if (crack) held = law.faces(*crack, next);
    crack_at(law, crack, next, law.energy(next) - held.energy);
    const double now = crack ? crack->damage : 0;
    const Tensor6 elastic = stress_of(next);
    const double energy = 0.5 * contract(next, elastic);
    if (crack) {
      friction += now * law.slide_faces(*crack, next);
      held = law.faces(*crack, next);
      dissipated += (now - damage) * (energy - held.energy);
    }
    Tensor6 force;
    for (std::size_t v = 0; v < 6; ++v) force[v] = (1 - now) * elastic[v] + now * held.stress[v];
    for (std::size_t v = 0; v < 6; ++v) work += (v < 3 ? 1 : 2) * 0.5 * (force[v] + stress[v]) * (next[v] - strain[v]);
    stored = (1 - now) * energy + now * held.energy;
    strain = next;
    stress = force;
  }
  EXPECT_GT(dissipated, 0.1 * work);
  EXPECT_GT(friction, 0.02 * work);
  EXPECT_NEAR((stored + dissipated + friction) / work, 1, 2e-4);
}

}  // namespace
}  // namespace koshi::failure
