// Boundary types of effective stiffnesses: their order, mirror images, phases, and what fills the box.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "koshi/directional.h"
#include "koshi/error.h"
#include "support/first_ranks.h"
#include "support/periodic_block.h"

namespace koshi {
namespace {

using homogenize::Boundary;
using material::Kinematics;
using test::effective;
using test::fill;
using test::periodic_block;

// Whole numbers without order: the same on every machine.
int scrambled(const Int3& c) {
  auto h = static_cast<std::uint32_t>(c[0] * 73856093 ^ c[1] * 19349663 ^ c[2] * 83492791);
  h = (h ^ h >> 15) * 2246822519u;
  h = (h ^ h >> 13) * 3266489917u;
  return static_cast<int>((h ^ h >> 16) % 1000);
}

// Least eigenvalue of the difference of two stiffnesses, by the largest entry.
double least_difference(const homogenize::Effective& stiff, const homogenize::Effective& soft) {
  Eigen::Matrix<double, 6, 6> D;
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j)
      D(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          (stiff.stiffness.voigt[i][j] - soft.stiffness.voigt[i][j]) / stiff.stiffness.voigt[0][0];
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>>(D).eigenvalues()(0);
}

// What a boundary type holds is less from left to right (theory, chapter 14), so every mean strain takes less energy;
// in a random mixture strictly so.
TEST(HomogenizeBoundaries, DisplacementIsStifferThanPeriodicThanTraction) {
  int compared = 0;
  for (const Kinematics kinematics : {Kinematics::rotational, Kinematics::least_squares}) {
    const Int3 cells{6, 6, 6};
    model::Definition definition = periodic_block(cells);
    definition.lattice.kinematics = kinematics;
    fill(definition, cells, [](const Int3& c) { return 1 + scrambled(c) % 3; });
    const auto displacement = effective(definition, Communicator::self(), Boundary::displacement);
    const auto mixed = effective(definition, Communicator::self(), Boundary::mixed);
    const auto periodic = effective(definition, Communicator::self());
    const auto traction = effective(definition, Communicator::self(), Boundary::traction);
    EXPECT_GT(least_difference(displacement, periodic), 1e-3);
    EXPECT_GT(least_difference(periodic, traction), 1e-3);
    EXPECT_GT(least_difference(displacement, mixed), 1e-4);
    for (const auto* found : {&displacement, &periodic, &traction}) {
      // All see the same phases, in the same box.
      ASSERT_EQ(found->phases.size(), 3u);
      EXPECT_EQ(found->bounds.hashin_lower.bulk, periodic.bounds.hashin_lower.bulk);
      EXPECT_LT(found->asymmetry, 1e-8);
      ++compared;
    }
  }
  EXPECT_EQ(compared, 6);
}

// Exact, but that a uniform traction is not what a lattice in uniform strain needs along the edges of the box, where
// the moments of its springs do not cancel (theory, chapter 6): free nodes turn there and soften a box of a few cells.
// With least-squares springs that is 0.07 % of the shear moduli at four cells.
TEST(HomogenizeBoundaries, OneMaterialKeepsItsStiffness) {
  const material::ElasticTensor C = material::elastic_tensor(test::three_elastics[0]);
  int compared = 0;
  for (const Kinematics kinematics : {Kinematics::rotational, Kinematics::least_squares})
    for (const Boundary boundary : {Boundary::displacement, Boundary::mixed, Boundary::traction}) {
      SCOPED_TRACE(testing::Message() << static_cast<int>(kinematics) << static_cast<int>(boundary));
      model::Definition definition = periodic_block({4, 5, 3});
      definition.lattice.kinematics = kinematics;
      const auto found = effective(definition, Communicator::self(), boundary);
      const bool traction = boundary == Boundary::traction, turning = kinematics == Kinematics::rotational;
      for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t j = 0; j < 6; ++j, ++compared) {
          const double difference = (found.stiffness.voigt[i][j] - C.voigt[i][j]) / C.voigt[0][0];
          if (traction && turning) {
            EXPECT_GT(difference, -0.2) << i << j;
            EXPECT_LT(difference, i == j ? -0.01 : 0.1) << i << j;
          } else if (traction && i == j && i >= 3) {
            EXPECT_GT(difference, -4e-4) << i;
            EXPECT_LT(difference, -1e-4) << i;
          } else {
            EXPECT_NEAR(difference, 0, 1e-9) << i << j;
          }
        }
    }
  EXPECT_EQ(compared, 6 * 36);
}

// Smooth plates are mirrors: the box with its seven mirror images, repeated, has the same stiffness.
TEST(HomogenizeBoundaries, MixedIsThatOfTheMirroredBox) {
  const Int3 cells{4, 3, 5}, twice{8, 6, 10};
  for (const Kinematics kinematics : {Kinematics::rotational, Kinematics::least_squares}) {
    model::Definition one = periodic_block(cells), eight = periodic_block(twice);
    one.lattice.kinematics = eight.lattice.kinematics = kinematics;
    const auto material_of = [&](const Int3& c) { return scrambled(c) % 4; };  // with voids
    fill(one, cells, material_of);
    fill(eight, twice, [&](const Int3& c) {
      Int3 image;
      for (std::size_t a = 0; a < 3; ++a) image[a] = c[a] < cells[a] ? c[a] : 2 * cells[a] - 1 - c[a];
      return material_of(image);
    });
    const auto found = effective(one, Communicator::self(), Boundary::mixed);
    const auto expected = effective(eight, Communicator::self());
    const double scale = expected.stiffness.voigt[0][0];
    EXPECT_GT(scale, 1e8);
    int compared = 0;
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t j = 0; j < 6; ++j, ++compared)
        EXPECT_NEAR(found.stiffness.voigt[i][j] / scale, expected.stiffness.voigt[i][j] / scale, 1e-8) << i << j;
    EXPECT_EQ(compared, 36);
  }
}

// Means of the phases add up to the whole: sum of fraction times stress is C, times strain the unit matrix.
TEST(HomogenizeBoundaries, PhasesAddUp) {
  const Int3 cells{6, 6, 6};
  model::Definition definition = periodic_block(cells);
  fill(definition, cells, [](const Int3& c) { return 1 + scrambled(c) % 3; });
  int compared = 0;
  for (const Boundary boundary : {Boundary::periodic, Boundary::displacement, Boundary::traction}) {
    const auto found = effective(definition, Communicator::self(), boundary);
    ASSERT_EQ(found.means.size(), 3u);
    SCOPED_TRACE(static_cast<int>(boundary));
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t j = 0; j < 6; ++j, ++compared) {
        double stress = 0, strain = 0;
        for (std::size_t p = 0; p < 3; ++p) {
          stress += found.phases[p].fraction * found.means[p].stress[i][j];
          strain += found.phases[p].fraction * found.means[p].strain[i][j];
        }
        EXPECT_NEAR(stress / found.stiffness.voigt[0][0], found.stiffness.voigt[i][j] / found.stiffness.voigt[0][0],
                    1e-8);
        EXPECT_NEAR(strain, i == j ? 1 : 0, 1e-8) << i << j;
      }
  }
  EXPECT_EQ(compared, 3 * 36);
}

TEST(HomogenizeBoundaries, AreTheSameOnAnyRanks) {
  const Int3 cells{6, 12, 12};
  model::Definition definition = periodic_block(cells);
  fill(definition, cells, [](const Int3& c) { return 1 + scrambled(c) % 3; });
  int compared = 0;
  for (const Boundary boundary : {Boundary::displacement, Boundary::mixed, Boundary::traction}) {
    const auto one = effective(definition, Communicator::self(), boundary);
    const auto group = test::first_ranks(4);
    if (!group) continue;
    const auto four = effective(definition, *group, boundary);
    EXPECT_EQ(four.stiffness.voigt, one.stiffness.voigt);
    EXPECT_EQ(four.means[1].stress, one.means[1].stress);
    EXPECT_EQ(four.structure.specific_surface, one.structure.specific_surface);
    ++compared;
  }
  EXPECT_EQ(Communicator::world().sum(std::int64_t{compared}), 3 * 4);
}

TEST(HomogenizeBoundaries, VoidsOnTheSurfaceCarryNoTraction) {
  const Int3 cells{4, 4, 4};
  model::Definition definition = periodic_block(cells);
  fill(definition, cells, [](const Int3& c) { return c == Int3{0, 2, 2} ? 0 : 1; });
  EXPECT_THAT([&] { effective(definition, Communicator::self(), Boundary::traction); },
              testing::ThrowsMessage<InputError>(testing::HasSubstr("1 void cells lie on the surface")));
  // One inside carries none either, and is no reason to refuse.
  fill(definition, cells, [](const Int3& c) { return c == Int3{1, 2, 2} ? 0 : 1; });
  EXPECT_GT(effective(definition, Communicator::self(), Boundary::traction).stiffness.voigt[0][0], 1e10);
}

// A slit through the box along x, one voxel that ends, and a grain that hangs free in a hole.
TEST(HomogenizeStructure, PoresSurfaceAndIslands) {
  const Int3 cells{8, 8, 8};
  model::Definition definition = periodic_block(cells);
  fill(definition, cells, [](const Int3& c) {
    if (c[1] == 1 && c[2] == 1) return 0;  // 8 cells, through along x
    if (c == Int3{0, 5, 1}) return 0;      // a dead end at one side
    const bool hole = c[0] > 2 && c[0] < 6 && c[1] > 3 && c[1] < 7 && c[2] > 3 && c[2] < 7;
    return hole ? (c == Int3{4, 5, 5} ? 2 : 0) : 1;  // 26 void cells around one of b
  });
  const homogenize::Structure found = effective(definition, Communicator::self()).structure;
  EXPECT_DOUBLE_EQ(found.porosity, (8 + 1 + 26) / 512.0);
  EXPECT_DOUBLE_EQ(found.connected_porosity, 8 / 512.0);
  EXPECT_DOUBLE_EQ(found.through[0], 8 / 512.0);
  EXPECT_EQ(found.through[1], 0);
  // Faces: 4 of each cell of the slit, 6 of the single one, 6 x 9 outside and 6 inside of the hole; over 512 d^3.
  EXPECT_DOUBLE_EQ(found.specific_surface, (32 + 6 + 54 + 6) / (512 * 0.01));
  EXPECT_EQ(found.islands, 1);
  EXPECT_DOUBLE_EQ(found.island_fraction, 1 / 512.0);
}

material::ElasticTensor turned(const material::ElasticTensor& C, const Eigen::Matrix3d& R) {
  constexpr int index[6][2] = {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
  material::ElasticTensor T;
  for (int a = 0; a < 6; ++a)
    for (int b = 0; b < 6; ++b) {
      double sum = 0;
      for (int p = 0; p < 3; ++p)
        for (int q = 0; q < 3; ++q)
          for (int r = 0; r < 3; ++r)
            for (int s = 0; s < 3; ++s)
              sum += R(index[a][0], p) * R(index[a][1], q) * R(index[b][0], r) * R(index[b][1], s) * C(p, q, r, s);
      T.voigt[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)] = sum;
    }
  return T;
}

// Copper, C11 = 168.4, C12 = 121.4, C44 = 75.4 GPa, in a frame turned at random: the search finds it again.
TEST(ClosestTensors, ATurnedCrystalIsFound) {
  material::ElasticTensor crystal;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) crystal.voigt[i][j] = i == j ? 168.4e9 : 121.4e9;
    crystal.voigt[3 + i][3 + i] = 75.4e9;
  }
  const Eigen::Matrix3d R = Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, -2, 0.7).normalized()).toRotationMatrix();
  const homogenize::Closest cubic = homogenize::closest_cubic(turned(crystal, R));
  EXPECT_LT(cubic.distance, 1e-7);
  EXPECT_NEAR(cubic.tensor.voigt[0][0] / 168.4e9, 1, 1e-9);
  EXPECT_NEAR(cubic.tensor.voigt[3][3] / 75.4e9, 1, 1e-9);
  // Its axes are those of the crystal, in any order and sign.
  for (const Vec3& axis : cubic.axes) {
    double best = 0;
    for (int a = 0; a < 3; ++a)
      best = std::max(best, std::abs(axis[0] * R(0, a) + axis[1] * R(1, a) + axis[2] * R(2, a)));
    EXPECT_NEAR(best, 1, 1e-9);
  }
  // A = 2 C44 / (C11 - C12) = 3.2085; A^U = 6/5 (sqrt(A) - 1/sqrt(A))^2 for cubic crystals (Ranganathan and
  // Ostoja-Starzewski 2008): 1.8242.
  EXPECT_NEAR(homogenize::universal_anisotropy(turned(crystal, R)).value(), 1.8242, 1e-4);
  EXPECT_GT(homogenize::closest_transverse(crystal).distance, 0.1);
}

TEST(ClosestTensors, TheAxisOfLayersIsFound) {
  // Isotropic about its axis: shale, C11 = 34.3, C33 = 22.7, C44 = 5.4, C66 = 10.6, C13 = 10.7 GPa.
  material::ElasticTensor shale;
  auto& V = shale.voigt;
  V[0][0] = V[1][1] = 34.3e9;
  V[2][2] = 22.7e9;
  V[3][3] = V[4][4] = 5.4e9;
  V[5][5] = 10.6e9;
  V[0][1] = V[1][0] = 34.3e9 - 2 * 10.6e9;
  V[0][2] = V[2][0] = V[1][2] = V[2][1] = 10.7e9;
  const Eigen::Matrix3d R = Eigen::AngleAxisd(0.8, Eigen::Vector3d(2, 1, -0.3).normalized()).toRotationMatrix();
  const homogenize::Closest found = homogenize::closest_transverse(turned(shale, R));
  EXPECT_LT(found.distance, 1e-7);
  EXPECT_NEAR(std::abs(found.axes[2][0] * R(0, 2) + found.axes[2][1] * R(1, 2) + found.axes[2][2] * R(2, 2)), 1, 1e-9);
  EXPECT_NEAR(found.tensor.voigt[2][2] / 22.7e9, 1, 1e-9);
  // Closer to a tensor of few constants no tensor of more can be further away.
  EXPECT_LT(homogenize::closest_transverse(shale).distance, homogenize::closest_isotropic(shale).distance);
  EXPECT_LT(homogenize::closest_cubic(shale).distance, homogenize::closest_isotropic(shale).distance);
  EXPECT_NEAR(material::youngs_modulus(material::elastic_tensor(test::three_elastics[1]), {1, 2, -3}).value() / 6e9, 1,
              1e-12);
}

}  // namespace
}  // namespace koshi
