// The force kernel against a brute-force sum over cells and bonds, and its invariants.
#include <gtest/gtest.h>

#include <random>

#include "mechanics/force_kernel.h"
#include "support/bodies.h"
#include "support/brute_force.h"

namespace koshi {
namespace {

using material::Kinematics;
using material::Sharing;
using material::Springs;
using Nodes = std::vector<std::array<double, 6>>;

// Springs without any symmetry between families, so that no mix-up cancels.
std::vector<Springs> three_materials(double kappa) {
  return {Springs{}, Springs{{1.0, 0.7, 0.45}, {0.31, 0.22, 0.13}, kappa * 0.9},
          Springs{{2.1, 1.3, 0.65}, {0.91, 0.42, 0.33}, kappa * 1.7},
          Springs{{0.4, 0.17, 0.25}, {0.11, 0.05, 0.03}, 0.0}};
}

struct Case {
  Sharing sharing;
  Kinematics kinematics;
  double kappa;
  bool mixed;
  std::array<bool, 3> periodic;
};

std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << (c.sharing == Sharing::shared ? "shared " : "plain ")
             << (c.kinematics == Kinematics::rotational ? "rotational" : "least-squares") << " kappa " << c.kappa
             << (c.mixed ? " mixed" : " uniform") << (c.periodic[0] ? " periodic" : "");
}

class Forces : public testing::TestWithParam<Case> {
 protected:
  model::SpringLattice body() const {
    const Case& c = GetParam();
    std::mt19937 random(5);
    std::vector<std::uint16_t> cells(11 * 6 * 5, 1);
    if (c.mixed)
      for (auto& m : cells) m = static_cast<std::uint16_t>(random() % 4);
    return test::make_body(
        {11, 6, 5}, 0.8, c.sharing, c.kinematics, three_materials(c.kappa),
        [cells](const Int3& p) { return cells[static_cast<std::size_t>(p[0] + 11 * (p[1] + 6 * p[2]))]; }, c.periodic);
  }

  static lattice::Field<double> field(const model::SpringLattice& body, const Nodes& u) {
    lattice::Field<double> f(body.layout, body.components());
    std::size_t n = 0;
    lattice::for_each_owned(body.layout, [&](auto, auto, auto, auto at) {
      for (int c = 0; c < body.components(); ++c) f.component(c)[at] = u[n][static_cast<std::size_t>(c)];
      ++n;
    });
    return f;
  }

  static Nodes kernel_force(const model::SpringLattice& body, const Nodes& u) {
    mechanics::ForceKernel kernel(body);
    auto input = field(body, u);
    lattice::Field<double> output(body.layout, body.components());
    kernel.apply(input, output);
    Nodes result;
    lattice::for_each_owned(body.layout, [&](auto, auto, auto, auto at) {
      result.emplace_back();
      for (int c = 0; c < body.components(); ++c) result.back()[static_cast<std::size_t>(c)] = output.component(c)[at];
    });
    return result;
  }

  static Nodes random_nodes(const model::SpringLattice& body, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    Nodes u(static_cast<std::size_t>(body.grid.node_count()));
    for (auto& node : u)
      for (double& x : node) x = uniform(random);
    return u;
  }
};

// Both sum the same few hundred terms of order 1, so they agree to about 1e-14.
TEST_P(Forces, EqualTheSumOverCellsAndBonds) {
  const auto b = body();
  const Nodes u = random_nodes(b, 1);
  const test::BruteForce expected = test::brute_force(b, u);
  const Nodes force = kernel_force(b, u);
  ASSERT_EQ(force.size(), expected.force.size());
  double largest = 0;
  for (std::size_t n = 0; n < force.size(); ++n)
    for (int c = 0; c < b.components(); ++c) {
      EXPECT_NEAR(force[n][static_cast<std::size_t>(c)], expected.force[n][static_cast<std::size_t>(c)], 2e-13)
          << "node " << n << " component " << c;
      largest = std::max(largest, std::abs(force[n][static_cast<std::size_t>(c)]));
    }
  EXPECT_GT(largest, 1.0);  // the comparison was not one of zeros
  // The force is linear, so the energy is -u.F/2.
  double work = 0;
  for (std::size_t n = 0; n < force.size(); ++n)
    for (int c = 0; c < b.components(); ++c)
      work += u[n][static_cast<std::size_t>(c)] * force[n][static_cast<std::size_t>(c)];
  EXPECT_NEAR(-0.5 * work, expected.energy, 1e-12 * expected.energy);
}

// F = -dE/du: central differences of a quadratic energy are exact up to the rounding of E ~ 1e3, about 1e-12 / (2 h).
TEST_P(Forces, AreMinusTheGradientOfTheEnergy) {
  const auto b = body();
  Nodes u = random_nodes(b, 2);
  const Nodes force = kernel_force(b, u);
  const double h = 0.1;
  int checked = 0;
  for (std::size_t n = 3; n < u.size(); n += 37)
    for (int c = 0; c < b.components(); ++c) {
      double& x = u[n][static_cast<std::size_t>(c)];
      const double x0 = x;
      x = x0 + h;
      const double up = test::brute_force(b, u).energy;
      x = x0 - h;
      const double down = test::brute_force(b, u).energy;
      x = x0;
      EXPECT_NEAR(force[n][static_cast<std::size_t>(c)], -(up - down) / (2 * h), 1e-10);
      ++checked;
    }
  EXPECT_GE(checked, 21);
}

// Six rigid motions: translations, and rotations u = w x X with node rotation w.
TEST_P(Forces, VanishForEachRigidMotion) {
  const auto b = body();
  const int motions = GetParam().periodic[0] ? 3 : 6;  // a periodic body cannot rotate
  for (int motion = 0; motion < motions; ++motion) {
    Nodes u;
    lattice::for_each_owned(b.layout, [&](auto i, auto j, auto k, auto) {
      const Vec3 X = b.grid.position({i, j, k});
      Vec3 t{}, w{};
      (motion < 3 ? t : w)[static_cast<std::size_t>(motion % 3)] = 1;
      const Vec3 r = t + cross(w, X);
      u.push_back({r[0], r[1], r[2], w[0], w[1], w[2]});
    });
    const Nodes force = kernel_force(b, u);
    for (std::size_t n = 0; n < force.size(); ++n)
      for (int c = 0; c < b.components(); ++c)
        ASSERT_NEAR(force[n][static_cast<std::size_t>(c)], 0, 3e-14 * 10 * 10) << "motion " << motion << " node " << n;
  }
}

// v.K u = u.K v.
TEST_P(Forces, AreSymmetric) {
  const auto b = body();
  const Nodes u = random_nodes(b, 3), v = random_nodes(b, 4);
  const Nodes Ku = kernel_force(b, u), Kv = kernel_force(b, v);
  double a = 0, c = 0;
  for (std::size_t n = 0; n < u.size(); ++n)
    for (int i = 0; i < b.components(); ++i) {
      a += v[n][static_cast<std::size_t>(i)] * Ku[n][static_cast<std::size_t>(i)];
      c += u[n][static_cast<std::size_t>(i)] * Kv[n][static_cast<std::size_t>(i)];
    }
  EXPECT_NEAR(a, c, 1e-11 * 100);
}

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (const auto sharing : {Sharing::shared, Sharing::plain})
    for (const auto kinematics : {Kinematics::rotational, Kinematics::least_squares})
      for (const double kappa : {0.0, 1.3})
        for (const bool mixed : {false, true})
          for (const auto& periodic : {std::array<bool, 3>{false, false, false}, std::array<bool, 3>{true, true, true}})
            cases.push_back({sharing, kinematics, kappa, mixed, periodic});
  return cases;
}

INSTANTIATE_TEST_SUITE_P(All, Forces, testing::ValuesIn(all_cases()));

}  // namespace
}  // namespace koshi
