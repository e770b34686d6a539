// What the shared springs must give to rounding: E and nu, shear, layers, symmetry, balance.
#include <gtest/gtest.h>

#include <algorithm>

#include "model/choices.h"
#include "support/cases.h"
#include "support/equilibrium.h"

namespace koshi {
namespace {

using lattice::CellType;
using material::Calibration;
using material::Kinematics;
using model::Face;
using Quantity = model::ProbeDefinition::Quantity;
using Reduce = model::ProbeDefinition::Reduce;

constexpr double d = 0.002;

struct Choice {
  CellType cell;
  Calibration calibration;
  Kinematics kinematics;
};

std::ostream& operator<<(std::ostream& out, const Choice& c) {
  return out << name(c.cell) << ' ' << model::choice_name(c.calibration)
             << (c.kinematics == Kinematics::rotational ? " rotational" : " least-squares");
}

std::vector<Choice> all_choices() {
  std::vector<Choice> all;
  for (const auto kinematics : {Kinematics::rotational, Kinematics::least_squares}) {
    for (const auto cell : {CellType::cube_i, CellType::cube_ii, CellType::cube_iii})
      all.push_back({cell, Calibration::isotropic, kinematics});
    all.push_back({CellType::cube_iii, Calibration::bending_exact, kinematics});
  }
  // With the fit these are the bending-exact springs.
  all.push_back({CellType::cube_iii, Calibration::beam_exact, Kinematics::rotational});
  return all;
}

// Cube-I is claimed from nu = 0 on.
std::vector<double> ratios(const Choice& choice) {
  if (choice.cell == CellType::cube_i) return {0, 0.18, 0.3, 0.49};
  return {-0.5, 0, 0.18, 0.3, 0.49};
}

class Exact : public testing::TestWithParam<Choice> {
 protected:
  static model::Definition body(const Int3& cells, double nu) {
    const Choice& choice = GetParam();
    model::Definition definition = test::block(cells, d, {1112e6, nu, 2000});
    definition.lattice.cell = choice.cell;
    definition.lattice.calibration = choice.calibration;
    definition.lattice.kinematics = choice.kinematics;
    definition.analysis.type = model::AnalysisDefinition::Type::statics;
    return definition;
  }
};

model::BoundaryDefinition moved(model::BoundaryDefinition boundary, std::size_t component, double value) {
  boundary.fix[component] = false;
  boundary.displacement[component] = value;
  return boundary;
}

// Smooth platens whose nodes do not turn about axes in their plane: sigma = E eps over the whole box, so F / A / eps =
// E and the sides move by nu eps.
TEST_P(Exact, UniaxialCompressionGivesTheModulusAndPoissonsRatio) {
  const Int3 cells{3, 2, 5};
  int checked = 0;
  for (const double nu : ratios(GetParam())) {
    model::Definition definition = body(cells, nu);
    const double height = 5 * d, strain = -0.01;
    definition.boundaries = {test::fixed("bottom", Face::z_min, {2, 3, 4, 5}),
                             moved(test::fixed("top", Face::z_max, {3, 4, 5}), 2, strain * height)};
    definition.probes = {test::probe("force", Face::z_max, Quantity::reaction, Reduce::sum)};
    test::Equilibrium solved(definition);
    const double E = solved.probe(0)[2] / (6 * d * d) / strain;
    EXPECT_NEAR(E / 1112e6, 1, 1e-10) << "nu " << nu;
    for (const auto& [i, j, k] : {Int3{0, 0, 0}, Int3{0, 1, 2}, Int3{0, 2, 5}}) {
      const double lateral = (solved.u(0, 3, j, k) - solved.u(0, i, j, k)) / (3 * d);
      EXPECT_NEAR(-lateral / strain - nu, 0, 1e-10) << "nu " << nu;
      ++checked;
    }
    const double across = (solved.u(1, 1, 2, 3) - solved.u(1, 1, 0, 3)) / (2 * d);
    EXPECT_NEAR(-across / strain - nu, 0, 1e-10) << "nu " << nu;
  }
  EXPECT_EQ(checked, 3 * static_cast<int>(ratios(GetParam()).size()));
}

// A sheet without end between two plates, one moved along itself by gamma h: F / A = mu gamma. Nodes turn by half the
// shear angle, so the plates do.
TEST_P(Exact, SimpleShearGivesTheShearModulus) {
  for (const double nu : ratios(GetParam()))
    for (const std::size_t along : {0U, 1U}) {
      model::Definition definition = body({3, 2, 4}, nu);
      definition.body.periodic = {true, true, false};
      const double gamma = 0.02, mu = 1112e6 / (2 * (1 + nu));
      definition.boundaries = {test::fixed("bottom", Face::z_min, {0, 1, 2}),
                               moved(test::fixed("top", Face::z_max, {0, 1, 2}), along, gamma * 4 * d)};
      if (GetParam().kinematics == Kinematics::rotational)
        for (auto& plate : definition.boundaries)
          // Rotation about y by (du_x/dz) / 2, about x by -(du_y/dz) / 2.
          for (std::size_t c = 0; c < 3; ++c)
            plate.displacement[3 + c] = c == 1 - along ? (along == 0 ? 0.5 : -0.5) * gamma : 0;
      definition.probes = {test::probe("force", Face::z_max, Quantity::reaction, Reduce::sum)};
      test::Equilibrium solved(definition);
      EXPECT_NEAR(solved.probe(0)[along] / (6 * d * d) / gamma / mu, 1, 1e-10) << "nu " << nu;
      EXPECT_NEAR(solved.u(static_cast<int>(along), 1, 1, 1), gamma * d, 1e-10 * gamma * d);
    }
}

// Two layers between rollers: no lateral strain, the same stress in both, so u = sigma (h1 / M1 + h2 / M2) with
// M = lambda + 2 mu, and the interface moves by sigma h1 / M1.
TEST_P(Exact, TwoLayersShareTheStress) {
  for (const auto& [nu1, nu2] : {std::pair(0.0, 0.3), std::pair(0.18, 0.45), std::pair(0.49, 0.25)}) {
    model::Definition definition = body({3, 2, 5}, nu1);
    definition.materials.push_back({"clay", {90e6, nu2, 1500}});
    model::RegionDefinition upper;
    upper.min = {0, 0, 3 * d};
    upper.max = {3 * d, 2 * d, 5 * d};
    upper.material = "clay";
    definition.regions = {upper};
    const double u = -1e-5;
    definition.boundaries = {
        test::fixed("bottom", Face::z_min, {2, 3, 4, 5}), moved(test::fixed("top", Face::z_max, {3, 4, 5}), 2, u),
        test::fixed("left", Face::x_min, {0, 3, 4, 5}),   test::fixed("right", Face::x_max, {0, 3, 4, 5}),
        test::fixed("front", Face::y_min, {1, 3, 4, 5}),  test::fixed("back", Face::y_max, {1, 3, 4, 5})};
    definition.probes = {test::probe("force", Face::z_max, Quantity::reaction, Reduce::sum)};
    test::Equilibrium solved(definition);
    const auto M = [](const material::Elastic& e) { return e.lambda() + 2 * e.mu(); };
    const double lower = 3 * d / M(definition.materials[0].elastic),
                 all = lower + 2 * d / M(definition.materials[1].elastic);
    const double stress = u / all;
    EXPECT_NEAR(solved.probe(0)[2] / (6 * d * d) / stress, 1, 1e-10) << nu1 << ' ' << nu2;
    EXPECT_NEAR(solved.u(2, 1, 1, 3) / (stress * lower), 1, 1e-10);
    EXPECT_NEAR(solved.u(2, 3, 0, 3) / (stress * lower), 1, 1e-10);
  }
}

// Body axes turned and mirrored in all 48 ways: a cantilever of three materials with holes bends the same.
TEST_P(Exact, AnswersTurnWithTheAxes) {
  const Int3 size{6, 3, 2};
  const auto material_at = [](const Int3& p) {
    return static_cast<std::uint16_t>((p[0] * 7 + p[1] * 5 + p[2] * 3 + p[0] * p[1]) % 4 == 0 && p[0] > 0 && p[0] < 5
                                          ? 0
                                          : 1 + (p[0] + 2 * p[1] + p[2]) % 3);
  };
  double energy0 = 0, largest_difference = 0;
  Vec3 tip0{};
  int checked = 0;
  std::array<std::size_t, 3> axes{0, 1, 2};  // original axis a lies along axes[a]
  do {
    for (unsigned mirrored = 0; mirrored < 8; ++mirrored) {
      Int3 cells{};
      for (std::size_t a = 0; a < 3; ++a) cells[axes[a]] = size[a];
      model::Definition definition = body(cells, 0.2);
      definition.materials.push_back({"soft", {200e6, 0.3, 1000}});
      definition.materials.push_back({"hard", {5e9, 0.1, 3000}});
      const auto original = [&](const Int3& p) {
        Int3 q{};
        for (std::size_t a = 0; a < 3; ++a) q[a] = mirrored >> a & 1 ? size[a] - 1 - p[axes[a]] : p[axes[a]];
        return q;
      };
      for (std::int64_t k = 0; k < cells[2]; ++k)
        for (std::int64_t j = 0; j < cells[1]; ++j)
          for (std::int64_t i = 0; i < cells[0]; ++i) definition.body.cells.push_back(material_at(original({i, j, k})));
      const auto face = [&](std::size_t axis, bool upper) {
        return static_cast<Face>(2 * axes[axis] + ((mirrored >> axis & 1) != 0 ? !upper : upper));
      };
      definition.boundaries = {test::fixed("root", face(0, false), {0, 1, 2, 3, 4, 5})};
      model::LoadDefinition load;
      load.selection.face = face(0, true);
      load.force = Vec3{};
      const Vec3 force{0.3, 1, -0.7};
      for (std::size_t a = 0; a < 3; ++a) (*load.force)[axes[a]] = (mirrored >> a & 1 ? -1 : 1) * force[a];
      definition.loads = {load};
      definition.probes = {test::probe("tip", face(0, true), Quantity::displacement, Reduce::area_mean)};
      test::Equilibrium solved(definition);
      Vec3 tip{};
      for (std::size_t a = 0; a < 3; ++a) tip[a] = (mirrored >> a & 1 ? -1 : 1) * solved.probe(0)[axes[a]];
      const double energy = solved.measurement().balance.elastic_energy;
      if (checked++ == 0) {
        energy0 = energy;
        tip0 = tip;
        EXPECT_GT(norm(tip), 1e-7);
        EXPECT_LT(solved.model().cell_count, 36);  // there are holes
      }
      EXPECT_NEAR(energy / energy0, 1, 1e-11);
      largest_difference = std::max(largest_difference, norm(tip - tip0) / norm(tip0));
    }
  } while (std::next_permutation(axes.begin(), axes.end()));
  EXPECT_EQ(checked, 48);
  EXPECT_LT(largest_difference, 1e-11);
}

// Reactions balance the loads, forces and moments, in a body of three materials with holes.
TEST_P(Exact, ReactionsBalanceTheLoads) {
  model::Definition definition = body({5, 4, 4}, 0.25);
  definition.materials.push_back({"soft", {100e6, 0.4, 1000}});
  definition.materials.push_back({"hard", {9e9, 0.1, 3000}});
  for (int n = 0; n < 80; ++n)
    definition.body.cells.push_back(static_cast<std::uint16_t>(n % 7 == 3 && n % 5 != 0 && n % 5 != 4 ? 0 : 1 + n % 3));
  definition.boundaries = {test::fixed("root", Face::x_min, {0, 1, 2, 3, 4, 5})};
  model::LoadDefinition load;
  load.selection.face = Face::x_max;
  load.force = Vec3{3, -4, 5};
  definition.loads = {load};
  definition.probes = {test::probe("root", Face::x_min, Quantity::moment, Reduce::sum)};
  test::Equilibrium solved(definition);
  EXPECT_LT(solved.model().cell_count, 80);

  const lattice::Field<double> reactions = solved.meter().reactions(solved.state());
  // The root has all its nodes, so their mean is the centre of the face.
  const Vec3 root{0, 2 * d, 2 * d};
  Vec3 force{}, moment{}, moment_about_root{};
  lattice::for_each_owned(solved.model().layout(), [&](auto i, auto j, auto k, auto n) {
    Vec3 R{}, M{};
    for (int c = 0; c < reactions.components(); ++c)
      (c < 3 ? R : M)[static_cast<std::size_t>(c % 3)] = reactions.component(c)[n];
    force = force + R;
    moment = moment + cross(solved.model().lattice.grid.position({i, j, k}), R) + M;
    moment_about_root = moment_about_root + cross(solved.model().lattice.grid.position({i, j, k}) - root, R) + M;
  });
  ASSERT_EQ(solved.probe(0).size(), 3U);
  EXPECT_GT(norm(moment_about_root), 0.05);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(solved.probe(0)[c], moment_about_root[c], 1e-13) << c;
  for (const auto& [node, f] : solved.model().loads[0].forces) {
    force = force + f;
    lattice::for_each_owned(solved.model().layout(), [&](auto i, auto j, auto k, auto n) {
      if (n == node) moment = moment + cross(solved.model().lattice.grid.position({i, j, k}), f);
    });
  }
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(force[c], 0, 1e-11) << c;          // of 7 N
    EXPECT_NEAR(moment[c], 0, 1e-11 * 0.01) << c;  // of 7 N on 1 cm
  }
}

INSTANTIATE_TEST_SUITE_P(All, Exact, testing::ValuesIn(all_choices()));

}  // namespace
}  // namespace koshi
