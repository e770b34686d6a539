// Cells at surfaces: moments of the part inside, and the forces that they give.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

#include <cmath>
#include <random>

#include "koshi/calibration.h"
#include "koshi/input.h"
#include "koshi/model.h"
#include "lattice/halo.h"
#include "mechanics/cell_matrix.h"
#include "mechanics/cell_stress.h"
#include "mechanics/cut_forces.h"
#include "mechanics/force_kernel.h"
#include "mechanics/strain_tie.h"
#include "model/moments.h"
#include "model/plane_cut.h"

namespace koshi::mechanics {
namespace {

using material::Kinematics;
using model::moment_powers;
using model::Moments;

double factorial(int n) { return n < 2 ? 1 : n * factorial(n - 1); }
double choose(int n, int k) { return factorial(n) / factorial(k) / factorial(n - k); }

TEST(CutMoments, OfACornerAreThoseOfItsSimplex) {
  // Over the corner X + Y + Z <= t, X = x + 1, the integral of X^a Y^b Z^c is a! b! c!/(a + b + c + 3)! t^(a + b + c +
  // 3); x^a is a sum of powers of X.
  for (const double t : {0.3, 1.0, 2.0}) {
    const Moments moments = model::moments_below({{0, 0, 0}, 1}, {2, 2, 2}, 2 * (t - 3));
    for (std::size_t m = 0; m < moments.size(); ++m) {
      const auto [a, b, c] = moment_powers[m];
      double exact = 0;
      for (int i = 0; i <= a; ++i)
        for (int j = 0; j <= b; ++j)
          for (int k = 0; k <= c; ++k) {
            const int n = i + j + k + 3;
            exact += choose(a, i) * choose(b, j) * choose(c, k) * ((a + b + c - i - j - k) % 2 == 0 ? 1 : -1) *
                     factorial(i) * factorial(j) * factorial(k) / factorial(n) * std::pow(t, n) / 8;
          }
      EXPECT_NEAR(moments[m], exact, 1e-14) << t << ' ' << m;
    }
  }
}

TEST(CutMoments, OfCubesAndPartsOfThemAddUp) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-1, 1);
  const Moments whole = model::moments_of_cube({{0, 0, 0}, 1});
  for (int sample = 0; sample < 50; ++sample) {
    const Vec3 normal{any(random), any(random), any(random)};
    const double offset = any(random);
    const Moments below = model::moments_below({{0, 0, 0}, 1}, normal, offset);
    const Moments above = model::moments_below({{0, 0, 0}, 1}, -1.0 * normal, -offset);
    EXPECT_NEAR(below[0], model::part_below(normal, 0.5 * offset), 1e-8);
    // The same plane in eight small cubes.
    Moments parts{};
    for (int c = 0; c < 8; ++c) {
      const Vec3 centre{c & 1 ? 0.5 : -0.5, c & 2 ? 0.5 : -0.5, c & 4 ? 0.5 : -0.5};
      const Moments part = model::moments_below({centre, 0.5}, normal, offset - dot(normal, centre));
      for (std::size_t m = 0; m < parts.size(); ++m) parts[m] += part[m];
    }
    for (std::size_t m = 0; m < parts.size(); ++m) {
      EXPECT_NEAR(below[m] + above[m], whole[m], 1e-14) << sample << ' ' << m;
      EXPECT_NEAR(below[m], parts[m], 1e-14) << sample << ' ' << m;
    }
  }
  // A plane on a face of the cube counts the face once.
  EXPECT_EQ(model::moments_below({{0, 0, 0}, 1}, {0, 3, 0}, 3), whole);
  EXPECT_EQ(model::moments_below({{0, 0, 0}, 1}, {0, 3, 0}, -3), Moments{});
  EXPECT_NEAR(model::moments_below({{0, 0, 0}, 1}, {0, 3, 0}, 0)[2], -0.25, 1e-15);  // half, mean y = -1/2
}

// A body of 2 x 2 x 2 cells of side d = 0.5 around the cell that the test is about; parts are set by hand.
struct OneCell {
  static constexpr double d = 0.5;

  OneCell(Kinematics kinematics, double nu, const Moments& moments)
      : model(model::make_model(
            io::read_case_text(
                fmt::format("[lattice]\nspacing = 0.5\nkinematics = \"{}\"\n[material.rock]\nyoungs_modulus = 1\n"
                            "poissons_ratio = {}\ndensity = 1\n[body]\nsize = [0.5, 0.5, 0.5]\nmaterial = \"rock\"\n",
                            kinematics == Kinematics::rotational ? "rotational" : "least-squares", nu),
                "case.toml"),
            Communicator::world())) {
    model::SpringLattice& body = model.lattice;
    cell = body.layout.index(0, 0, 0);
    body.fraction = lattice::Field<float>(body.layout, 1);
    body.fraction.component(0)[cell] = static_cast<float>(moments[0]);
    body.factor = body.fraction;
    body.surface = {{cell, moments}};
  }

  // The stiffness of the cell as the kernel has it and what comes at the surface, node by node as cell_matrix().
  Eigen::MatrixXd stiffness() const {
    const int n = model.components();
    Eigen::MatrixXd K =
        model.lattice.factor_of(cell) * without_tie(cell_matrix(model.lattice.springs[1], d, model.lattice.kinematics));
    for (std::size_t q = 0; q < 24; ++q) {
      std::array<Vec3, 8> displacement{};
      displacement[q / 3][q % 3] = 1;
      const std::array<Vec3, 8> force = cut_forces(model.lattice, model.lattice.surface[0], displacement);
      for (std::size_t p = 0; p < 24; ++p)
        K(static_cast<Eigen::Index>(p / 3) * n + static_cast<Eigen::Index>(p % 3),
          static_cast<Eigen::Index>(q / 3) * n + static_cast<Eigen::Index>(q % 3)) -= force[p / 3][p % 3];
    }
    return K;
  }

  model::Model model;
  std::int64_t cell = 0;
};

TEST(CutForces, HaveTheEnergyOfThePartInside) {
  // Half a cell, x < 0: Gauss with three points a direction is exact. The dilatation counts by its mean.
  const Moments half = model::moments_below({{0, 0, 0}, 1}, {1, 0, 0}, 0);
  const OneCell one(Kinematics::least_squares, 0.3, half);
  const double mu = 1 / 2.6, bulk = 1 / (3 * 0.4), d = OneCell::d;
  Eigen::MatrixXd exact = Eigen::MatrixXd::Zero(24, 24);
  Eigen::RowVectorXd mean = Eigen::RowVectorXd::Zero(24);
  const std::array<double, 3> place{-std::sqrt(0.6), 0, std::sqrt(0.6)}, weight{5.0 / 18, 8.0 / 18, 5.0 / 18};
  // The strain of all corners at a place; its constant part is that of the centre.
  const auto strain_at = [&](const Vec3& x) {
    Eigen::MatrixXd B = Eigen::MatrixXd::Zero(6, 24);
    for (int a = 0; a < 8; ++a) {
      Vec3 slope;
      for (int c = 0; c < 3; ++c) {
        const auto sign = [&](int e) { return 2.0 * corner(a)[static_cast<std::size_t>(e)] - 1; };
        const int p = (c + 1) % 3, q = (c + 2) % 3;
        slope[static_cast<std::size_t>(c)] = sign(c) * (1 + sign(p) * x[static_cast<std::size_t>(p)]) *
                                             (1 + sign(q) * x[static_cast<std::size_t>(q)]) / (4 * d);
      }
      for (int c = 0; c < 3; ++c) {
        const int e = (c + 1) % 3;
        B(c, 3 * a + c) = slope[static_cast<std::size_t>(c)];
        B(3 + c, 3 * a + c) = slope[static_cast<std::size_t>(e)];
        B(3 + c, 3 * a + e) = slope[static_cast<std::size_t>(c)];
      }
    }
    return B;
  };
  const auto add = [&](const Eigen::MatrixXd& B, double share) {
    const Eigen::RowVectorXd dilatation = B.row(0) + B.row(1) + B.row(2);
    for (int c = 0; c < 3; ++c) {
      const Eigen::RowVectorXd own = B.row(c) - dilatation / 3;
      exact += share * mu * (2 * own.transpose() * own + B.row(3 + c).transpose() * B.row(3 + c));
    }
  };
  for (std::size_t g = 0; g < 27; ++g) {
    const double share = 0.5 * d * d * d * weight[g % 3] * weight[g / 3 % 3] * weight[g / 9];
    const Eigen::MatrixXd B = strain_at({-0.5 + 0.5 * place[g % 3], place[g / 3 % 3], place[g / 9]});
    mean += share * (B.row(0) + B.row(1) + B.row(2));
    add(B, share);
    // A tenth of what gradients have in the whole cell, times the half that is inside.
    add(strain_at({place[g % 3], place[g / 3 % 3], place[g / 9]}) - strain_at({0, 0, 0}), 0.1 * share);
  }
  exact += bulk * mean.transpose() * mean / (0.5 * d * d * d);
  EXPECT_LT((one.stiffness() - exact).cwiseAbs().maxCoeff(), 1e-7 * exact.cwiseAbs().maxCoeff());
}

TEST(CutForces, RotationsThatAreFreeTakeNoEnergy) {
  // The smallest energy over the rotations is that of the part inside, which least-squares kinematics has alone.
  for (const double nu : {-0.5, 0.0, 0.3, 0.45}) {
    const Moments part = model::moments_below({{0, 0, 0}, 1}, {0.5, -0.6, 0.7}, 0.3);
    const Eigen::MatrixXd K = OneCell(Kinematics::rotational, nu, part).stiffness();
    const Eigen::MatrixXd exact = OneCell(Kinematics::least_squares, nu, part).stiffness();
    Eigen::MatrixXd uu(24, 24), uw(24, 24), ww(24, 24);
    for (Eigen::Index p = 0; p < 24; ++p)
      for (Eigen::Index q = 0; q < 24; ++q) {
        const Eigen::Index row = p / 3 * 6 + p % 3, column = q / 3 * 6 + q % 3;
        uu(p, q) = K(row, column);
        uw(p, q) = K(row, column + 3);
        ww(p, q) = K(row + 3, column + 3);
      }
    const Eigen::MatrixXd least = uu - uw * ww.ldlt().solve(uw.transpose());
    EXPECT_LT((least - exact).cwiseAbs().maxCoeff(), 1e-6 * exact.cwiseAbs().maxCoeff()) << nu;
  }
}

TEST(CutForces, TakeNoEnergyWithoutMotionAndNeverGiveAny) {
  int checked = 0;
  const auto check = [&checked](const OneCell& one, const std::string& what) {
    const Eigen::MatrixXd K = one.stiffness();
    const double largest = K.cwiseAbs().maxCoeff();
    EXPECT_LT((K - K.transpose()).cwiseAbs().maxCoeff(), 1e-12 * largest) << what;
    const auto values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K, Eigen::EigenvaluesOnly).eigenvalues();
    EXPECT_GT(values(0), -1e-8 * largest) << what;
    EXPECT_LT(std::abs(values(5)), 1e-8 * largest) << what;  // rigid motions
    EXPECT_GT(values(6), 1e-7 * largest) << what;
    ++checked;
  };
  for (const double nu : {-0.5, -0.3, 0.0, 0.3, 0.45}) {
    for (const double offset : {-1.4, -0.6, 0.0, 0.7})
      for (const Kinematics kinematics : {Kinematics::rotational, Kinematics::least_squares})
        check({kinematics, nu, model::moments_below({{0, 0, 0}, 1}, {0.5, -0.6, 0.7}, offset)},
              fmt::format("nu {} offset {}", nu, offset));
  }
  EXPECT_EQ(checked, 5 * 8);
}

model::Model made(const std::string& regions, const char* material, const char* kinematics) {
  return model::make_model(
      io::read_case_text(
          fmt::format("[lattice]\nspacing = 0.125\nkinematics = \"{}\"\n[material.rock]\nyoungs_modulus = 2\n"
                      "poissons_ratio = 0.2\ndensity = 1\n[body]\norigin = [-1, -1, -1]\nsize = [2, 2, "
                      "2]\nmaterial = \"{}\"\nsurface = \"cut\"\n{}",
                      kinematics, material, regions),
          "case.toml"),
      Communicator::world());
}

// The largest force, over d^2 and a stress of 1, at nodes that see cut cells in the balanced stress t t along the plane
// normal . x = 0.05; the box's faces and corners of slivers that are left out do not count.
double imbalance(const Vec3& normal, const Vec3& t, const char* kinematics) {
  const Vec3 point = 0.05 * normal;
  const model::Model model =
      made(fmt::format(
               "[[region]]\nshape = \"half-space\"\npoint = [{:.17g}, {:.17g}, {:.17g}]\nnormal = [{:.17g}, {:.17g}, "
               "{:.17g}]\nmaterial = \"void\"\n",
               point[0], point[1], point[2], -normal[0], -normal[1], -normal[2]),
           "rock", kinematics);
  const lattice::Layout& layout = model.layout();
  const lattice::Grid& grid = model.lattice.grid;
  // E = 2, nu = 0.2: strain (1 + nu) t t/E - nu/E 1, without rotation.
  lattice::Field<double> u(layout, model.components()), force(layout, model.components());
  lattice::for_each_owned(layout, [&](auto i, auto j, auto k, auto n) {
    const Vec3 x = grid.position({i, j, k});
    const Vec3 moved = (0.6 * dot(t, x)) * t + (-0.1) * x;
    for (int c = 0; c < 3; ++c) u.component(c)[n] = moved[static_cast<std::size_t>(c)];
  });
  ForceKernel kernel(model.lattice);
  kernel.apply(u, force);
  int checked = 0;
  double largest = 0;
  lattice::for_each_owned(layout, [&](auto i, auto j, auto k, auto n) {
    if (i < 1 || j < 1 || k < 1 || i > 15 || j > 15 || k > 15) return;
    bool cut = false, sliver = false;
    for (int a = 0; a < 8; ++a) {
      const std::int64_t at = n - layout.offset({a & 1, a >> 1 & 1, a >> 2});
      const Vec3 middle = grid.position({i - (a & 1), j - (a >> 1 & 1), k - (a >> 2)}) + (0.5 * grid.d) * Vec3{1, 1, 1};
      const double part = model::part_below(normal, (0.05 - dot(normal, middle)) / grid.d);
      cut = cut || (part > 0.02 && part < 1);
      sliver = sliver || (part > 0 && model.lattice.cell.component(0)[at] == 0);
    }
    if (!cut || sliver) return;
    ++checked;
    for (int c = 0; c < model.components(); ++c)
      largest = std::max(largest, std::abs(force.component(c)[n]) / (grid.d * grid.d * (c < 3 ? 1 : grid.d)));
  });
  EXPECT_GT(checked, 200);
  return largest;
}

TEST(CutForces, BalanceUniformStressAlongAnObliqueSurface) {
  const Vec3 across = (1 / std::sqrt(13.0)) * Vec3{0, 2, 3};
  const Vec3 normal = (1 / std::sqrt(14.0)) * Vec3{1, 2, 3}, t = (1 / std::sqrt(5.0)) * Vec3{2, -1, 0};
  for (const char* kinematics : {"rotational", "least-squares"}) {
    // Fractions are single numbers of 24 bits.
    EXPECT_LT(imbalance(across, {1, 0, 0}, kinematics), 1e-6) << kinematics;
    // Shear in the lattice's planes too: nothing ties it to other motions. With the springs' tie 0.04 is left.
    EXPECT_LT(imbalance(normal, t, kinematics), 1e-6) << kinematics;
  }
}

TEST(CutForces, EnergyOfCellsIsTheWorkOfForces) {
  for (const char* kinematics : {"rotational", "least-squares"}) {
    const model::Model model =
        made("[[region]]\nshape = \"sphere\"\ncenter = [0.03, 0.01, -0.02]\nradius = 0.83\nmaterial = \"rock\"\n",
             "void", kinematics);
    const lattice::Layout& layout = model.layout();
    ASSERT_GT(model.lattice.surface.size(), 500u);
    lattice::Field<double> u(layout, model.components()), force(layout, model.components());
    std::mt19937 random(3);
    std::uniform_real_distribution<double> any(-1, 1);
    lattice::for_each_owned(layout, [&](auto, auto, auto, auto n) {
      for (int c = 0; c < model.components(); ++c) u.component(c)[n] = any(random) * (c < 3 ? model.lattice.grid.d : 1);
    });
    ForceKernel kernel(model.lattice);
    kernel.apply(u, force);
    double work = 0, energy = 0;
    const double volume = std::pow(model.lattice.grid.d, 3);
    lattice::for_each_owned(layout, [&](auto, auto, auto, auto n) {
      for (int c = 0; c < model.components(); ++c) work -= 0.5 * u.component(c)[n] * force.component(c)[n];
      if (model.lattice.cell.component(0)[n] != 0) energy += volume * cell_state(model.lattice, u, n).energy;
    });
    EXPECT_GT(work, 0);
    EXPECT_NEAR(energy, work, 1e-12 * work) << kinematics;
  }
}

}  // namespace
}  // namespace koshi::mechanics
