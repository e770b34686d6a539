// Coarsened images whose cells hold two solids.
#include <gtest/gtest.h>

#include <cmath>

#include "io/cell_image.h"
#include "support/first_ranks.h"
#include "support/layers.h"
#include "support/periodic_block.h"

namespace koshi {
namespace {

using material::Elastic;

Elastic of(double K, double G, double density = 2000) {
  return {9 * K * G / (3 * K + G), (3 * K - 2 * G) / (2 * (3 * K + G)), density};
}
double bulk(const Elastic& e) { return e.lambda() + 2 * e.mu() / 3; }

// A periodic block of n cells along each axis, each of edge^3 voxels; the voxels are of material 1 or 2.
template <class F>
model::Definition coarsened(const Int3& n, int edge, const Elastic& first, const Elastic& second, F&& is_second) {
  model::Definition definition = test::periodic_block(n);
  definition.materials = {{"first", first}, {"second", second}};
  definition.body.material.clear();
  definition.body.image_materials = {{0, "first"}, {1, "second"}};
  definition.body.scan.emplace();
  definition.body.scan->coarsen = edge;
  const Int3 voxels{edge * n[0], edge * n[1], edge * n[2]};
  io::set_cells(
      {voxels,
       {1, voxels[0], voxels[0] * voxels[1]},
       [&](std::int64_t at) {
         return is_second(Int3{at % voxels[0], at / voxels[0] % voxels[1], at / (voxels[0] * voxels[1])}) ? 1.0 : 0.0;
       }},
      definition);
  // The cells are here; a program that gives them has no image to scan.
  definition.body.scan.reset();
  definition.body.image_materials.clear();
  return definition;
}

// Voxels of a ball with a part `fraction` of the cube of n cells.
auto ball(std::int64_t voxels, double fraction) {
  return [=](const Int3& at) {
    double square = 0;
    for (const std::int64_t x : at)
      square += std::pow((static_cast<double>(x) + 0.5) / static_cast<double>(voxels) - 0.5, 2);
    return square < std::pow(3 * fraction / (4 * std::acos(-1)), 2.0 / 3);
  };
}

// Layers of 5 and 3 cells whose two interfaces go through the middle of cells. With equal shear moduli the mixture has
// the layers' stiffness in every direction; without, it is a layer of its own.
TEST(Mixtures, LayersThatCutCells) {
  int compared = 0;
  for (const double G : {44e9, 120e9})
    for (int axis = 0; axis < 3; ++axis) {
      Int3 n{4, 4, 4};
      n[axis] = 8;
      const Elastic first = of(37e9, 44e9), second = of(148e9, G);
      model::Definition definition =
          coarsened(n, 2, first, second, [&](const Int3& at) { return at[axis] >= 5 && at[axis] < 11; });
      definition.lattice.kinematics = material::Kinematics::least_squares;
      ASSERT_EQ(definition.body.mixtures.size(), 1u);
      const homogenize::Effective found = test::effective(definition, Communicator::self());
      const Elastic& mixed = definition.materials[2].elastic;
      const std::vector<Elastic> cells{first, first, mixed, second, second, mixed, first, first};
      compared += test::compare(found.stiffness, test::backus(axis, cells), 1e-8);
      const std::vector<Elastic> halves{first, first, first, first, first, second, second, second};
      if (G == 44e9) compared += test::compare(found.stiffness, test::backus(axis, halves), 1e-8);
    }
  EXPECT_EQ(compared, 9 * 36);
}

// 1/(K + 4 G/3) is the mean of those of the solids (Hill), whatever the shape. By the majority of its voxels a cell is
// one solid or the other: 1.3 % at 16 cells a period (docs/validation/digital-rock.md), and it has lost where the ball
// ends.
TEST(Mixtures, HillsBulkModulusOfABall) {
  const double G = 44e9, K = 37e9;
  constexpr std::int64_t n = 16;
  const model::Definition definition = coarsened({n, n, n}, 4, of(K, G), of(4 * K, G), ball(4 * n, 0.2));
  EXPECT_GT(definition.body.mixtures.size(), 7u);
  const homogenize::Effective found = test::effective(definition, Communicator::self());
  double share = 0;
  for (std::int64_t z = 0; z < 4 * n; ++z)
    for (std::int64_t y = 0; y < 4 * n; ++y)
      for (std::int64_t x = 0; x < 4 * n; ++x) share += ball(4 * n, 0.2)({x, y, z}) / std::pow(4.0 * n, 3);
  const double right = 1 / ((1 - share) / (K + 4 * G / 3) + share / (4 * K + 4 * G / 3)) - 4 * G / 3;
  const homogenize::Moduli moduli = homogenize::closest_isotropic(found.stiffness).moduli;
  EXPECT_NEAR(moduli.bulk / right, 1, 0.0035);
  EXPECT_GT(std::abs(moduli.bulk / right - 1), 1e-5);  // the lattice's own error is there
  EXPECT_NEAR(moduli.shear / G, 1, 1e-3);
  // The share of the ball by sixteenths is that of the voxels.
  ASSERT_EQ(found.phases.size(), 2u);
  EXPECT_NEAR(found.phases[1].fraction / share, 1, 5e-3);
}

// Balls ten times as stiff in a simple cubic array, a fifth of the volume: scripts/sphere_array_series.py. By majority
// C11 is 5 % too large.
TEST(Mixtures, StiffBallsMeetTheSeries) {
  constexpr std::int64_t n = 16;
  const model::Definition definition = coarsened({n, n, n}, 4, of(37e9, 44e9), of(370e9, 440e9), ball(4 * n, 0.2));
  const homogenize::Effective found = test::effective(definition, Communicator::self());
  EXPECT_NEAR(found.stiffness.voigt[0][0] / 138.99692e9, 1, 0.012);
  EXPECT_NEAR(found.stiffness.voigt[0][1] / 12.481966e9, 1, 0.012);
  EXPECT_NEAR(found.stiffness.voigt[3][3] / 59.350729e9, 1, 0.012);
}

// A mixed cell counts to both solids by its shares: phases are the solids of the input, and add up.
TEST(Mixtures, PhasesAddUp) {
  constexpr std::int64_t n = 8;
  const model::Definition definition =
      coarsened({n, n, n}, 3, of(37e9, 44e9, 2600), of(100e9, 30e9, 5000), ball(3 * n, 0.3));
  EXPECT_GT(definition.body.mixtures.size(), 3u);
  const homogenize::Effective found = test::effective(definition, Communicator::self());
  ASSERT_EQ(found.phases.size(), 2u);
  ASSERT_EQ(found.means.size(), 2u);
  EXPECT_NEAR(found.phases[0].fraction + found.phases[1].fraction, 1, 1e-14);
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j) {
      double stress = 0, strain = 0;
      for (std::size_t p = 0; p < 2; ++p) {
        EXPECT_EQ(found.means[p].material, found.phases[p].material);
        stress += found.phases[p].fraction * found.means[p].stress[i][j];
        strain += found.phases[p].fraction * found.means[p].strain[i][j];
      }
      EXPECT_NEAR(stress / 100e9, found.stiffness.voigt[i][j] / 100e9, 1e-8);
      EXPECT_NEAR(strain, i == j ? 1 : 0, 1e-8);
    }
  // The mass is that of the voxels, not of the sixteenths.
  double share = 0;
  for (std::int64_t z = 0; z < 3 * n; ++z)
    for (std::int64_t y = 0; y < 3 * n; ++y)
      for (std::int64_t x = 0; x < 3 * n; ++x) share += ball(3 * n, 0.3)({x, y, z}) / std::pow(3.0 * n, 3);
  EXPECT_NEAR(found.density / (2600 + 2400 * share), 1, 1e-6);
  EXPECT_GT(bulk(definition.materials.back().elastic), 37e9);
}

TEST(Mixtures, AreTheSameOnAnyRanks) {
  const model::Definition definition = coarsened({8, 8, 8}, 3, of(37e9, 44e9), of(100e9, 30e9), ball(24, 0.3));
  const homogenize::Effective one = test::effective(definition, Communicator::self());
  int compared = 0;
  for (const int ranks : {2, 4}) {
    const auto group = test::first_ranks(ranks);
    if (!group) continue;
    const homogenize::Effective several = test::effective(definition, *group);
    EXPECT_EQ(several.stiffness.voigt, one.stiffness.voigt) << ranks;
    EXPECT_EQ(several.means[1].stress, one.means[1].stress) << ranks;
    ++compared;
  }
  EXPECT_EQ(Communicator::world().sum(std::int64_t{compared}), 2 + 4);
}

}  // namespace
}  // namespace koshi
