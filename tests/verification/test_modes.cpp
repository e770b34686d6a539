// Natural frequencies against a dense solution of the same lattice and against formulas of the continuum.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include <cmath>
#include <numbers>
#include <tuple>

#include "koshi/modes.h"
#include "mechanics/force_kernel.h"

namespace koshi {
namespace {

using material::Kinematics;
using std::numbers::pi;

constexpr double E = 2.1e9, rho = 7850;

model::Definition box(const Int3& cells, double d, double nu) {
  model::Definition definition;
  definition.lattice.spacing = d;
  for (std::size_t a = 0; a < 3; ++a) definition.body.size[a] = d * static_cast<double>(cells[a]);
  definition.body.material = "rock";
  definition.materials = {{"rock", {E, nu, rho}}};
  definition.analysis.type = model::AnalysisDefinition::Type::modes;
  return definition;
}

void clamp(model::Definition& definition, model::Face face) {
  model::BoundaryDefinition root;
  root.name = "root";
  root.selection.face = face;
  root.fix.fill(true);
  definition.boundaries = {root};
}

modes::ModesReport search(const model::Definition& definition, model::Model* out = nullptr) {
  model::Model model = model::make_model(definition, Communicator::self());
  modes::ModesReport report = modes::find_modes(model);
  if (out != nullptr) *out = std::move(model);
  return report;
}

// Frequencies [Hz] of all modes by Eigen: K column by column from the force kernel, M from the masses.
std::vector<double> dense_frequencies(const model::Model& model) {
  const lattice::Layout& layout = model.layout();
  lattice::Field<double> u(layout, model.components()), force(layout, model.components());
  lattice::Field<double> held(layout, model.components());
  for (const auto& motion : model.motions) held.component(motion.component)[motion.node] = 1;
  std::vector<std::tuple<int, std::int64_t>> free;
  lattice::for_each_owned(layout, [&](auto, auto, auto, auto n) {
    for (int c = 0; c < model.components(); ++c)
      if (model.inertia.component(0)[n] > 0 && held.component(c)[n] == 0) free.emplace_back(c, n);
  });
  const auto size = static_cast<Eigen::Index>(free.size());
  Eigen::MatrixXd K(size, size), M = Eigen::MatrixXd::Zero(size, size);
  mechanics::ForceKernel kernel(model.lattice);
  for (Eigen::Index column = 0; column < size; ++column) {
    const auto [c, n] = free[static_cast<std::size_t>(column)];
    u.zero();
    u.component(c)[n] = 1;
    kernel.apply(u, force);
    for (Eigen::Index row = 0; row < size; ++row) {
      const auto [other, at] = free[static_cast<std::size_t>(row)];
      K(row, column) = -force.component(other)[at];
    }
    M(column, column) = model.inertia.component(c < 3 ? 0 : 1)[n];
  }
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> eigen(0.5 * (K + K.transpose()), M);
  std::vector<double> frequencies;
  for (const double square : eigen.eigenvalues())
    if (square > 1e-9 * eigen.eigenvalues().maxCoeff()) frequencies.push_back(std::sqrt(square) / (2 * pi));
  return frequencies;
}

struct Small {
  const char* name;
  Kinematics kinematics;
  bool held;
};

class SmallBodies : public testing::TestWithParam<Small> {};

// Two materials and a corner without a cell; every mode there is, so that the effective masses make up the whole mass.
TEST_P(SmallBodies, HaveTheModesOfTheDenseProblem) {
  const Small& small = GetParam();
  model::Definition definition = box({2, 2, 2}, 0.01, 0.2);
  definition.lattice.kinematics = small.kinematics;
  definition.materials.push_back({"soft", {0.1 * E, 0.3, 0.5 * rho}});
  definition.body.cells = {1, 2, 1, 1, 1, 2, 1, 0};
  if (small.held) clamp(definition, model::Face::x_min);
  definition.analysis.tolerance = 1e-13;
  const model::Model model = model::make_model(definition, Communicator::self());
  const std::vector<double> expected = dense_frequencies(model);
  ASSERT_EQ(expected.size(), static_cast<std::size_t>(model.node_count * model.components() - model.motion_count) -
                                 (small.held ? 0u : 6u));
  definition.analysis.count = static_cast<int>(expected.size());

  const modes::ModesReport report = search(definition);
  ASSERT_EQ(report.modes.size(), expected.size());
  EXPECT_EQ(report.projected_motions, small.held ? 0 : 6);
  std::array<double, 6> sum = report.rigid_effective_mass;
  for (std::size_t j = 0; j < expected.size(); ++j) {
    EXPECT_NEAR(report.modes[j].frequency / expected[j], 1, 1e-9) << j;
    EXPECT_GT(report.modes[j].modal_mass, 0);
    for (std::size_t a = 0; a < 6; ++a) sum[a] += report.modes[j].effective_mass[a];
  }
  for (std::size_t a = 0; a < 6; ++a) EXPECT_NEAR(sum[a] / report.total_effective_mass[a], 1, 1e-9) << a;
  // Rigid motions of a free body have all of its mass.
  double mass = 0;
  for (const auto cell : definition.body.cells) mass += cell == 0 ? 0 : (cell == 1 ? rho : 0.5 * rho) * 1e-6;
  if (!small.held) EXPECT_NEAR(report.rigid_effective_mass[0] / mass, 1, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Modes, SmallBodies,
                         testing::Values(Small{"free", Kinematics::rotational, false},
                                         Small{"held", Kinematics::rotational, true},
                                         Small{"free_fitted", Kinematics::least_squares, false},
                                         Small{"held_fitted", Kinematics::least_squares, true}),
                         [](const auto& info) { return std::string(info.param.name); });

// The part of a displacement field that lies in the modes with frequencies within `window` f of f.
double part_in_modes(const model::Model& model, const modes::ModesReport& report, double f, double window,
                     const std::function<Vec3(const Vec3&)>& u) {
  const auto nodes = static_cast<std::size_t>(model.layout().owned_count());
  double part = 0, whole = 0;
  for (const modes::Mode& mode : report.modes) {
    double product = 0;
    whole = 0;
    std::size_t at = 0;
    lattice::for_each_owned(model.layout(), [&](auto i, auto j, auto k, auto n) {
      const double mass = model.inertia.component(0)[n];
      const Vec3 value = u(model.lattice.grid.position({i, j, k}));
      for (std::size_t c = 0; c < 3; ++c) {
        product += mass * value[c] * mode.shape[at + c * nodes];
        whole += mass * value[c] * value[c];
      }
      ++at;
    });
    if (std::abs(mode.frequency / f - 1) < window) part += product * product / mode.modal_mass;
  }
  return part / whole;
}

// Lame's mode of a free cube of side L: u = (cos(pi x/L) sin(pi y/L), -sin(pi x/L) cos(pi y/L), 0) has no volume strain
// and no stress on any face, so f = c_s / (sqrt(2) L) whatever nu is. The fields of the three planes are not
// orthogonal: the lattice has a pair of modes at f and, for their sum, a single one that is several % low at 12 cells
// (second order). The sum has |s|^2 = 3/2 (1 - 8/pi^2) beside 1/2 of one field, which lies in it with |s|^2 / 4.5 =
// 0.063.
TEST(Modes, OfAFreeCubeHoldLamesForAnyPoissonsRatio) {
  constexpr double L = 0.12;
  for (const double nu : {0.1, 0.35}) {
    model::Definition definition = box({12, 12, 12}, L / 12, nu);
    const double f = std::sqrt(E / (2 * (1 + nu)) / rho) / (std::sqrt(2.0) * L);
    definition.analysis.near = f;
    definition.analysis.count = 7;
    const model::Model model = model::make_model(definition, Communicator::self());
    const modes::ModesReport report = modes::find_modes(model);
    ASSERT_EQ(report.modes.size(), 7u);
    EXPECT_GT(report.searched, 7);
    const auto lame = [&](const Vec3& X) {
      return Vec3{std::cos(pi * X[0] / L) * std::sin(pi * X[1] / L), -std::sin(pi * X[0] / L) * std::cos(pi * X[1] / L),
                  0};
    };
    EXPECT_NEAR(part_in_modes(model, report, f, 0.01, lame), 1 - (1 - 8 / (pi * pi)) / 3, 0.01) << nu;
  }
}

// Bending of a square bar of side h and length L in the first direction: (beta L)^2 / (2 pi L^2) sqrt(E I / (rho A)).
double bernoulli(double beta_L, double h, double L) {
  return beta_L * beta_L / (2 * pi * L * L) * std::sqrt(E / rho) * h / std::sqrt(12.0);
}

// Root of Timoshenko's frequency equation of a cantilever (T. C. Huang, 1961) below Bernoulli's frequency, with the
// shear coefficient 10 (1 + nu) / (12 + 11 nu) of a rectangle.
double timoshenko(double beta_L, double h, double L, double nu) {
  const double G_ratio = 2 * (1 + nu) * (12 + 11 * nu) / (10 * (1 + nu));  // E / (k G)
  const double r2 = h * h / 12 / (L * L), s2 = r2 * G_ratio;
  const auto equation = [&](double b) {
    const double root = std::sqrt((r2 - s2) * (r2 - s2) + 4 / (b * b));
    const double a = std::sqrt((root - (r2 + s2)) / 2), c = std::sqrt((root + r2 + s2) / 2);
    return 2 + (b * b * (r2 - s2) * (r2 - s2) + 2) * std::cosh(b * a) * std::cos(b * c) -
           b * (r2 + s2) / std::sqrt(1 - b * b * r2 * s2) * std::sinh(b * a) * std::sin(b * c);
  };
  double low = 0.8 * beta_L * beta_L, high = 1.001 * beta_L * beta_L;
  EXPECT_LT(equation(low) * equation(high), 0);
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (equation(low) * equation(middle) <= 0 ? high : low) = middle;
  }
  return bernoulli(std::sqrt(low), h, L);
}

// Pairs of equal bending modes, torsion and stretch between them: the bending ones along x have effective mass there.
std::vector<double> bending_along_x(const modes::ModesReport& report) {
  std::vector<double> frequencies;
  for (const modes::Mode& mode : report.modes)
    if (mode.effective_mass[0] > 1e-3 * report.total_effective_mass[0]) frequencies.push_back(mode.frequency);
  return frequencies;
}

TEST(Modes, OfACantileverFollowTheBeamFormulas) {
  constexpr double h = 0.04, L = 0.8, nu = 0.25;
  model::Definition definition = box({4, 80, 4}, 0.01, nu);
  clamp(definition, model::Face::y_min);
  definition.analysis.count = 7;
  const modes::ModesReport report = search(definition);
  const std::vector<double> found = bending_along_x(report);
  ASSERT_EQ(found.size(), 3u);
  EXPECT_NEAR(found[0] / bernoulli(1.87510, h, L), 1, 0.01);
  EXPECT_NEAR(found[0] / timoshenko(1.87510, h, L, nu), 1, 0.005);
  EXPECT_NEAR(found[1] / timoshenko(4.69409, h, L, nu), 1, 0.01);
  EXPECT_NEAR(found[2] / timoshenko(7.85476, h, L, nu), 1, 0.01);
  // Equal modes are told apart by direction, and a cantilever's first mode moves 61.3 % of the mass: the square of
  // (2/1.8751) 0.7341 = 0.783.
  EXPECT_NEAR(report.modes[0].frequency / report.modes[1].frequency, 1, 1e-8);
  EXPECT_NEAR(report.modes[0].effective_mass[0] / report.total_effective_mass[0], 0.613, 0.01);
  EXPECT_NEAR(report.modes[1].effective_mass[0] / report.total_effective_mass[0], 0, 1e-6);
  EXPECT_NEAR(report.modes[1].effective_mass[2] / report.total_effective_mass[2], 0.613, 0.01);
}

TEST(Modes, OfAFreeBeamStartWithBendingAndLeaveRigidMotionsOut) {
  constexpr double h = 0.03, L = 1.2, nu = 0.25;
  model::Definition definition = box({3, 120, 3}, 0.01, nu);
  definition.analysis.count = 4;
  const modes::ModesReport report = search(definition);
  ASSERT_EQ(report.modes.size(), 4u);
  EXPECT_EQ(report.projected_motions, 6);
  for (const int j : {0, 1})
    EXPECT_NEAR(report.modes[static_cast<std::size_t>(j)].frequency / bernoulli(4.73004, h, L), 1, 0.01);
  for (const int j : {2, 3})
    EXPECT_NEAR(report.modes[static_cast<std::size_t>(j)].frequency / bernoulli(7.85320, h, L), 1, 0.015);
  EXPECT_NEAR(report.rigid_effective_mass[0] / (rho * h * h * L), 1, 1e-9);
}

// Torsional vibration of a sphere, degree 2: (l - 1) j_l(x) = x j_(l+1)(x) with x = omega a / c_s; the least root for
// l = 2 is found here. A sphere of 10 cells a radius lies 3.2 % lower, one of 20 1.2 % (docs/validation/modes.md).
TEST(Modes, OfAFreeSphereStartWithTorsion) {
  const auto equation = [](double x) { return std::sph_bessel(2, x) - x * std::sph_bessel(3, x); };
  double low = 2, high = 3;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (equation(low) * equation(middle) <= 0 ? high : low) = middle;
  }
  EXPECT_NEAR(low, 2.501, 5e-4);
  constexpr double a = 0.1, nu = 0.25;
  model::Definition definition = box({20, 20, 20}, 0.01, nu);
  definition.body.material = "void";
  model::RegionDefinition ball;
  ball.shape = model::RegionDefinition::Shape::sphere;
  ball.material = "rock";
  ball.center = {a, a, a};
  ball.radius = a;
  definition.regions = {ball};
  definition.analysis.count = 5;
  const modes::ModesReport report = search(definition);
  const double f = low * std::sqrt(E / (2 * (1 + nu)) / rho) / a / (2 * pi);
  // Five modes of degree 2, split by the cube's axes.
  double mean = 0;
  for (const modes::Mode& mode : report.modes) {
    EXPECT_NEAR(mode.frequency / f, 0.968, 0.006);
    mean += mode.frequency / 5;
  }
  EXPECT_NEAR(mean / f, 0.968, 0.003);
}

// The same with a surface that cuts the cells, the middle at no node: nothing of the lattice is left in the five modes
// but 0.6 %, and the error, that of short waves, goes down with the square of the spacing: 4.3 % at 6 cells a radius.
TEST(Modes, OfASphereOfCutCellsConverge) {
  constexpr double a = 0.06, nu = 0.25;
  std::array<double, 2> error{};
  for (const std::int64_t finer : {1, 2}) {
    model::Definition definition = box({14 * finer, 14 * finer, 14 * finer}, 0.01 / static_cast<double>(finer), nu);
    definition.body.material = "void";
    definition.body.surface = model::BodyDefinition::Surface::cut;
    model::RegionDefinition ball;
    ball.shape = model::RegionDefinition::Shape::sphere;
    ball.material = "rock";
    ball.center = {0.0713, 0.0692, 0.0705};
    ball.radius = a;
    definition.regions = {ball};
    definition.analysis.count = 5;
    const modes::ModesReport report = search(definition);
    ASSERT_EQ(report.modes.size(), 5u);
    const double f = 2.501 * std::sqrt(E / (2 * (1 + nu)) / rho) / a / (2 * pi);
    EXPECT_LT(report.modes[4].frequency / report.modes[0].frequency, 1.007);
    error[static_cast<std::size_t>(finer) - 1] = 1 - report.modes[2].frequency / f;
  }
  EXPECT_NEAR(error[0], 0.0432, 0.003);
  EXPECT_NEAR(error[1], 0.0107, 0.001);
  EXPECT_NEAR(std::log2(error[0] / error[1]), 2, 0.1);
}

TEST(Modes, NearAFrequencyAreTheClosestOnes) {
  model::Definition definition = box({3, 5, 2}, 0.01, 0.25);
  definition.analysis.count = 30;
  const modes::ModesReport lowest = search(definition);
  const double near = 0.5 * (lowest.modes[16].frequency + lowest.modes[17].frequency);
  definition.analysis.near = near;
  definition.analysis.count = 4;
  const modes::ModesReport report = search(definition);
  std::vector<double> distances;
  for (const modes::Mode& mode : lowest.modes) distances.push_back(std::abs(mode.frequency - near));
  std::sort(distances.begin(), distances.end());
  ASSERT_EQ(report.modes.size(), 4u);
  for (const modes::Mode& mode : report.modes) {
    EXPECT_LE(std::abs(mode.frequency - near), distances[3] * (1 + 1e-6));
    EXPECT_NEAR(mode.frequency / lowest.modes[static_cast<std::size_t>(mode.number - 1)].frequency, 1, 1e-6);
  }
  definition.analysis.near = 1e9;
  EXPECT_THROW(search(definition), RunError);
}

template <class F>
std::string message(F&& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing was thrown";
}

TEST(Modes, RefuseWhatMakesNoSense) {
  using testing::HasSubstr;
  // Two cubes with a gap, one of them held.
  model::Definition definition = box({6, 2, 2}, 0.01, 0.25);
  clamp(definition, model::Face::x_min);
  model::RegionDefinition gap;
  gap.material = "void";
  gap.min = {0.02, 0, 0};
  gap.max = {0.04, 0.02, 0.02};
  definition.regions = {gap};
  definition.analysis.count = 2;
  EXPECT_THAT(message([&] { search(definition); }), HasSubstr("falls into 2 parts"));
  definition.analysis.allow_floating = true;
  const modes::ModesReport report = search(definition);
  EXPECT_EQ(report.projected_motions, 6);
  ASSERT_EQ(report.modes.size(), 2u);

  definition = box({1, 1, 1}, 0.01, 0.25);
  definition.lattice.kinematics = Kinematics::least_squares;
  definition.analysis.count = 19;
  EXPECT_THAT(message([&] { search(definition); }), HasSubstr("the body has 18 modes"));

  clamp(definition, model::Face::x_min);
  definition.boundaries[0].fix = {};
  definition.boundaries[0].displacement[1] = 0.001;
  EXPECT_THAT(message([&] { search(definition); }), HasSubstr("vibrations about the body at rest"));
  definition.boundaries[0].displacement[1] = 0;
  definition.output.checkpoint_every = 1;
  EXPECT_THAT(message([&] { search(definition); }), HasSubstr("checkpoint_every belongs to runs that go on in time"));
}

}  // namespace
}  // namespace koshi
