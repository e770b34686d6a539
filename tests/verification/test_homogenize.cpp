// Effective stiffness of periodic bodies against exact formulas.
#include "koshi/homogenize.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "koshi/directional.h"
#include "support/first_ranks.h"
#include "support/layers.h"
#include "support/periodic_block.h"

namespace koshi {
namespace {

using material::Calibration;
using material::Elastic;
using material::ElasticTensor;
using material::Kinematics;

using test::backus;
using test::compare;
using test::effective;
using test::fill;
using test::periodic_block;

const std::vector<Elastic>& elastics = test::three_elastics;

TEST(Homogenize, LayersAreThoseOfBackus) {
  // Strain is uniform in each layer, which trilinear cells represent: exact up to the residual of 1e-12 and rounding.
  int compared = 0;
  for (int axis = 0; axis < 3; ++axis)
    for (const int count : {2, 3}) {
      Int3 cells{4, 4, 4};
      cells[axis] = 2 * count;
      model::Definition definition = periodic_block(cells);
      definition.lattice.kinematics = Kinematics::least_squares;
      fill(definition, cells, [&](const Int3& c) { return 1 + c[axis] / 2; });
      const homogenize::Effective found = effective(definition, Communicator::self());
      const std::vector<Elastic> layers(elastics.begin(), elastics.begin() + count);
      compared += compare(found.stiffness, backus(axis, layers), 1e-8);
      EXPECT_LT(found.asymmetry, 1e-8);
      EXPECT_EQ(found.phases.size(), static_cast<std::size_t>(count));
    }
  EXPECT_EQ(compared, 6 * 36);
}

TEST(Homogenize, OneMaterialKeepsItsStiffness) {
  int compared = 0;
  for (const Kinematics kinematics : {Kinematics::rotational, Kinematics::least_squares})
    for (const Calibration calibration : {Calibration::bending_exact, Calibration::beam_exact, Calibration::isotropic})
      for (const lattice::CellType cell : {lattice::CellType::cube_ii, lattice::CellType::cube_iii}) {
        if (cell != lattice::CellType::cube_iii && calibration != Calibration::isotropic) continue;
        model::Definition definition = periodic_block({5, 4, 6});
        definition.lattice.cell = cell;
        definition.lattice.kinematics = kinematics;
        definition.lattice.calibration = calibration;
        const homogenize::Effective found = effective(definition, Communicator::self());
        compared += compare(found.stiffness, material::elastic_tensor(elastics[0]), 1e-10);
        EXPECT_LT(homogenize::closest_isotropic(found.stiffness).distance, 1e-10);
        // Rounding is no load: there is nothing to solve.
        EXPECT_EQ(found.cases[0].iterations, 0);
      }
  EXPECT_EQ(compared, 8 * 36);
}

TEST(Homogenize, EqualShearModuliGiveHillsBulkModulus) {
  // Hill 1963: 1 / (K + 4 G / 3) is the volume mean of those of the phases, whatever the geometry, and G is theirs: so
  // the stairs of a ball are as exact as the ball. The lattice converges at least with first order, the order at the
  // edges of the stairs: 0.5 % at 64 cells a period are 2 % at 16, and half the spacing has at most 0.6 of the error.
  const double G = 10e9;
  const auto of = [&](double K) { return Elastic{9 * K * G / (3 * K + G), (3 * K - 2 * G) / (2 * (3 * K + G)), 2000}; };
  double coarse_error = 0;
  for (const int refined : {1, 2}) {
    const std::int64_t n = 8 * refined;
    const Int3 cells{n, n, n};
    model::Definition definition = periodic_block(cells);
    definition.materials = {{"a", of(10e9)}, {"b", of(40e9)}};
    std::int64_t inside = 0;
    fill(definition, cells, [&](const Int3& c) {
      double square = 0;
      for (int a = 0; a < 3; ++a) square += std::pow(static_cast<double>(c[a] / refined) - 3.5, 2);
      inside += square < 9;
      return square < 9 ? 2 : 1;
    });
    const homogenize::Effective found = effective(definition, Communicator::self());
    const double share = static_cast<double>(inside) / static_cast<double>(n * n * n);
    const double K = 1 / ((1 - share) / (10e9 + 4 * G / 3) + share / (40e9 + 4 * G / 3)) - 4 * G / 3;
    const homogenize::Moduli moduli = homogenize::closest_isotropic(found.stiffness).moduli;
    const double error = std::abs(moduli.bulk / K - 1);
    EXPECT_LT(error, 0.02 * 2 / refined);
    EXPECT_NEAR(moduli.shear / G, 1, 0.02 * 2 / refined);
    if (refined == 2) {
      EXPECT_LT(error, 0.6 * coarse_error);
    }
    coarse_error = error;
    // Both bounds of Hashin and Shtrikman are this K, and Voigt's and Reuss' lie around it.
    EXPECT_NEAR(found.bounds.hashin_upper.bulk / K, 1, 1e-12);
    EXPECT_NEAR(found.bounds.hashin_lower.bulk / K, 1, 1e-12);
    EXPECT_GT(found.bounds.voigt.bulk, 1.02 * K);
    EXPECT_LT(found.bounds.reuss.bulk, 0.98 * K);
    EXPECT_LT(found.asymmetry, 1e-8);
  }
  EXPECT_GT(coarse_error, 0);
}

// Shear along a square array of cylindrical holes is conduction around them. Perrins, McKenzie and McPhedran 1979,
// Proc. R. Soc. Lond. A 369, 207, with T = 1 for holes: 1 - 2 f / (1 + f - 0.305827 f^4 / (1 - 1.402958 f^8) - 0.013362
// f^8). Cells are filled by the share of 8 x 8 points that are outside a hole; at 32 cells a period 0.3 % are left.
TEST(Homogenize, CylindricalHolesMeetTheSeries) {
  constexpr std::int64_t n = 32, points = 8;
  const Int3 cells{n, n, 2};
  int compared = 0;
  for (const double f : {0.2, 0.5}) {
    model::Definition definition = periodic_block(cells);
    definition.analysis.tolerance = 1e-8;
    fill(definition, cells, [&](const Int3& c) {
      int outside = 0;
      for (std::int64_t j = 0; j < points; ++j)
        for (std::int64_t i = 0; i < points; ++i) {
          const double x = (static_cast<double>(points * c[0] + i) + 0.5) / (n * points) - 0.5;
          const double y = (static_cast<double>(points * c[1] + j) + 0.5) / (n * points) - 0.5;
          outside += x * x + y * y >= f / std::numbers::pi;
        }
      definition.body.factors.push_back(outside == 0 ? 1.0F : static_cast<float>(outside) / (points * points));
      return outside == 0 ? 0 : 1;
    });
    const homogenize::Effective found = effective(definition, Communicator::self());
    const double f4 = std::pow(f, 4), f8 = f4 * f4;
    const double series = 1 - 2 * f / (1 + f - 0.305827 * f4 / (1 - 1.402958 * f8) - 0.013362 * f8);
    for (const std::size_t shear : {3, 4}) {
      EXPECT_NEAR(found.stiffness.voigt[shear][shear] / elastics[0].mu() / series, 1, 3e-3) << f << shear;
      ++compared;
    }
  }
  EXPECT_EQ(compared, 4);
}

TEST(Homogenize, AnIslandInVoidsCarriesNothing) {
  const Int3 cells{8, 8, 8};
  model::Definition definition = periodic_block(cells);
  // A cube across the corner of the box: the period joins its eight pieces.
  fill(definition, cells, [](const Int3& c) {
    return std::all_of(c.begin(), c.end(), [](std::int64_t x) { return x < 2 || x > 5; }) ? 1 : 0;
  });
  const homogenize::Effective found = effective(definition, Communicator::self());
  for (const auto& row : found.stiffness.voigt)
    for (const double entry : row) EXPECT_NEAR(entry / elastics[0].youngs_modulus, 0, 1e-9);
  EXPECT_DOUBLE_EQ(found.density, 2600.0 / 8);
  EXPECT_EQ(found.bounds.reuss.bulk, 0);
}

TEST(Homogenize, IsTheSameOnAnyRanks) {
  const Int3 cells{8, 16, 16};
  model::Definition definition = periodic_block(cells);
  fill(definition, cells, [](const Int3& c) { return (7 * c[0] + 3 * c[1] * c[2] + c[1]) % 5 % 4; });
  const homogenize::Effective one = effective(definition, Communicator::self());
  EXPECT_GT(one.stiffness.voigt[0][0], 1e9);
  int compared = 0;
  for (const int ranks : {2, 4}) {
    const auto group = test::first_ranks(ranks);
    if (!group) continue;
    const homogenize::Effective several = effective(definition, *group);
    ASSERT_EQ(group->size(), ranks);
    EXPECT_EQ(several.stiffness.voigt, one.stiffness.voigt) << ranks;
    EXPECT_EQ(several.asymmetry, one.asymmetry);
    EXPECT_EQ(several.bounds.hashin_upper.shear, one.bounds.hashin_upper.shear);
    ++compared;
  }
  EXPECT_EQ(Communicator::world().sum(std::int64_t{compared}), 2 + 4);
}

TEST(Homogenize, WaveSpeedsAreThoseOfTheSolid) {
  const ElasticTensor C = material::elastic_tensor(elastics[0]);
  const Vec3 speeds = material::wave_speeds(C, 2600, {1, -2, 0.5});
  EXPECT_NEAR(speeds[0] / elastics[0].p_wave_speed(), 1, 1e-12);
  EXPECT_NEAR(speeds[1] / elastics[0].s_wave_speed(), 1, 1e-12);
  EXPECT_NEAR(speeds[2] / elastics[0].s_wave_speed(), 1, 1e-12);
}

}  // namespace
}  // namespace koshi
