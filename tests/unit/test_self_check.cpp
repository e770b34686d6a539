// What springs really give, and the verdict on bad choices.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "mechanics/self_check.h"
#include "support/reference_cells.h"

namespace koshi::mechanics {
namespace {

using lattice::CellType;
using material::Calibration;
using material::Kinematics;
using material::Sharing;
using material::Springs;
using testing::HasSubstr;

constexpr double d = 0.002;

material::Elastic rock(double nu) { return {1112e6, nu, 2000}; }

/// Springs given in units of mu d, as theory.md gives them.
Springs in_units_of_mu_d(std::array<double, 3> kn, std::array<double, 3> kt, double nu) {
  for (double& k : kn) k *= rock(nu).mu() * d;
  for (double& k : kt) k *= rock(nu).mu() * d;
  return {kn, kt, 0};
}

SelfCheck check(const Springs& springs, Kinematics kinematics, double nu, Sharing sharing = Sharing::shared) {
  return self_check(springs, d, kinematics, sharing, rock(nu));
}

// Section 8: bending, its coupling and torsion are exact, for rotational springs up to nu = 0.302, where the floor
// begins.
TEST(SelfCheck, BendingExactSpringsAreExact) {
  int checked = 0;
  for (const double nu : {-0.9, -0.3, 0.0, 0.18, 0.3, 0.45, 0.499})
    for (const Kinematics kinematics : {Kinematics::rotational, Kinematics::least_squares}) {
      const auto springs = material::bending_exact_springs(rock(nu), d, kinematics);
      const EnergyRatios ratios = energy_ratios(springs, d, kinematics, rock(nu));
      EXPECT_NEAR(ratios.bending, 1, 1e-11) << nu;
      EXPECT_NEAR(ratios.dome_bending, 1, 1e-11) << nu;
      EXPECT_NEAR(ratios.saddle_bending, 1, 1e-11) << nu;
      if (kinematics == Kinematics::least_squares || nu <= 0.3) EXPECT_NEAR(ratios.torsion, 1, 1e-11) << nu;
      ++checked;
    }
  EXPECT_EQ(checked, 14);
}

// Beam-exact: torsion and the bending of a beam exact for every nu, uniform strain and stability besides. Below the
// floor f = 0.02, at nu = (2 - 9 f) / (6 - 9 f) = 0.31271, they are bending-exact; there they begin without a jump.
TEST(SelfCheck, BeamExactSpringsBendBeamsAndTwist) {
  int checked = 0, apart = 0;
  for (const double nu : {-0.9, -0.3, 0.0, 0.18, 0.3, 0.305, 0.3127, 0.3128, 0.35, 0.45, 0.49, 0.499})
    for (const Kinematics kinematics : {Kinematics::rotational, Kinematics::least_squares}) {
      if (kinematics == Kinematics::least_squares && nu < -0.2) continue;
      const auto springs = material::beam_exact_springs(rock(nu), d, kinematics);
      const SelfCheck found = check(springs, kinematics, nu);
      EXPECT_EQ(found.verdict, Verdict::ok) << nu;
      EXPECT_LT(found.C_error, 1e-13) << nu;
      EXPECT_NEAR(found.energy.beam_bending, 1, 1e-11) << nu;
      EXPECT_NEAR(found.energy.torsion, 1, 1e-11) << nu;
      EXPECT_GT(found.cell.smallest_nonzero, 0.002) << nu;
      const bool plates = kinematics == Kinematics::least_squares || nu < 0.31271;
      if (plates)
        EXPECT_NEAR(found.energy.bending, 1, 1e-11) << nu;
      else
        EXPECT_LT(found.energy.bending, 1 - 1e-5) << nu;
      apart += !plates;
      if (kinematics == Kinematics::rotational && nu >= 0)
        for (int family = 0; family < 3; ++family) {
          EXPECT_GE(springs.kt[family], 0.0199 * rock(nu).mu() * d) << nu;
          EXPECT_GE(springs.kn[family], 0.0199 * rock(nu).mu() * d) << nu;
        }
      ++checked;
    }
  EXPECT_EQ(checked, 22);
  EXPECT_EQ(apart, 5);

  const auto below = material::beam_exact_springs(rock(0.31271), d, Kinematics::rotational);
  const auto above = material::beam_exact_springs(rock(0.31272), d, Kinematics::rotational);
  const double scale = rock(0.31).mu() * d;
  for (int family = 0; family < 3; ++family) {
    EXPECT_NEAR(above.kn[family] / scale, below.kn[family] / scale, 1e-4);
    EXPECT_NEAR(above.kt[family] / scale, below.kt[family] / scale, 1e-4);
  }
}

// Plates give way at nu = 0.45: with C = 1/3 - 3/2 f = 0.3033 and B = (1.45 + sqrt(1.45^2 + 9 C^2)) / 3 = 1.05397
// and B_0 = 2 / (3 0.55): a cylinder keeps B / B_0 = 0.86952 of its energy, a dome (B + C) / (1.45 B_0) = 0.77226, a
// saddle (B - C) / (0.55 B_0) = 1.12595.
TEST(SelfCheck, BeamExactPlatesAreSoft) {
  const auto springs = material::beam_exact_springs(rock(0.45), d, Kinematics::rotational);
  const EnergyRatios ratios = energy_ratios(springs, d, Kinematics::rotational, rock(0.45));
  EXPECT_NEAR(ratios.bending, 0.86952, 1e-5);
  EXPECT_NEAR(ratios.dome_bending, 0.77226, 1e-5);
  EXPECT_NEAR(ratios.saddle_bending, 1.12595, 1e-5);
}

// Cube-I, nu = 0, kn = kt = 2 mu d, d = 1, edges 1/4. Least-squares: the fields have no mean gradient, so r is the
// plain difference. Bending u_y = -x y: bonds along x have |r| = 1/2 across, those along y |r| = 1/2 along: 8 bonds,
// 1/2 x 2/4 x 8 x 1/4 = 1/2 against E/24 = 1/12: 6. Torsion u = (0, -z x, y x): bonds along x r^2 = 1/2, along y and z
// r^2 = 1/4: 1/2 x 2/4 x (2 + 1 + 1) = 1 against mu/12: 12. With node rotations (0, 0, -y) the bonds along x turn as
// their ends move, r = 0, and those along y keep |r| = 1/2 (their mean rotation is 0): 1/4 against 1/12: 3.
TEST(SelfCheck, EnergyRatiosOfCubeI) {
  const auto springs = material::isotropic_springs(CellType::cube_i, rock(0), d);
  const EnergyRatios fitted = energy_ratios(springs, d, Kinematics::least_squares, rock(0));
  EXPECT_NEAR(fitted.bending, 6, 1e-12);
  EXPECT_NEAR(fitted.torsion, 12, 1e-12);
  EXPECT_NEAR(energy_ratios(springs, d, Kinematics::rotational, rock(0)).bending, 3, 1e-12);
}

// Good choices pass, and give the elastic constants.
TEST(SelfCheck, ReferenceChoices) {
  int ok = 0, gear = 0, refused = 0;
  for (const auto& reference : test::reference_cells()) {
    const double nu = reference.elastic.poissons_ratio;
    const auto springs = springs_for(reference.cell, reference.calibration, reference.kinematics, rock(nu), d);
    const SelfCheck found = check(springs, reference.kinematics, nu);
    EXPECT_LT(found.C_error, 1e-14) << reference.name;
    ASSERT_TRUE(found.constants.has_value()) << reference.name;
    EXPECT_NEAR(found.constants->youngs_modulus[1] / 1112e6, 1, 1e-12) << reference.name;
    EXPECT_NEAR(found.constants->poissons_ratio[2][0], nu, 1e-12) << reference.name;
    // The file's cell has d = mu = 1; the first eigenvalue above zero is the same in units of mu d.
    const auto first = std::find_if(reference.eigenvalues.begin(), reference.eigenvalues.end(),
                                    [](double value) { return value > 1e-6; });
    EXPECT_NEAR(found.cell.smallest_nonzero, *first, 1e-9) << reference.name;
    // The infinite lattice's own limit is never above that of (N26).
    EXPECT_GT(found.bulk_step, 0) << reference.name;
    EXPECT_LT(found.bulk_step, (1 + 1e-9) * d / rock(nu).p_wave_speed()) << reference.name;

    if (reference.cell == CellType::cube_i && reference.kinematics == Kinematics::rotational) {
      EXPECT_EQ(found.verdict, Verdict::warning) << reference.name;
      EXPECT_THAT(found.reason, HasSubstr("gear mode"));
      EXPECT_THAT(found.remedy, HasSubstr("least-squares"));
      EXPECT_EQ(found.cell.zero_modes_beyond_rigid, 6);
      ++gear;
    } else {
      EXPECT_EQ(found.verdict, Verdict::ok) << reference.name << ": " << found.reason;
      EXPECT_TRUE(found.reason.empty());
      EXPECT_EQ(found.cell.zero_modes_beyond_rigid, 0) << reference.name;
      EXPECT_EQ(found.zone.soft_vectors, 0) << reference.name;
      ++ok;
    }
    refused += found.verdict == Verdict::refuse;
  }
  EXPECT_EQ(ok, 34);
  EXPECT_EQ(gear, 5);
  EXPECT_EQ(refused, 0);
}

// Theory, section 8: with kt1 = kt2 = 0 (torsion exact at nu = 1/3: c = 1/3, t = 0) a cell has 22 zero modes, not 6.
TEST(SelfCheck, LooseRotationsAreRefused) {
  const Springs springs =
      in_units_of_mu_d({2.0 / 3, 1.0 / 3, 3.0 / 4 * (1 - 1.0 / 3 - 1.0 / 6)}, {0, 0, 0.25}, 1.0 / 3);
  const SelfCheck found = check(springs, Kinematics::rotational, 1.0 / 3);
  EXPECT_EQ(found.cell.zero_modes_beyond_rigid, 16);
  EXPECT_EQ(found.verdict, Verdict::refuse);
  EXPECT_THAT(found.reason, HasSubstr("nodes turn without any energy"));
  EXPECT_THAT(found.remedy, HasSubstr("shear stiffness"));
  EXPECT_FALSE(found.zone.soft_moves);
  // No rotations, no trouble.
  EXPECT_EQ(check(springs, Kinematics::least_squares, 1.0 / 3).verdict, Verdict::ok);
}

// The paper's formula beyond nu = 1/4: kt = 2/5 (mu - lambda) d < 0, kn = kt + lambda d.
TEST(SelfCheck, NegativeShearStiffnessIsRefused) {
  const double nu = 0.3, lambda = 2 * nu / (1 - 2 * nu), kt = 0.4 * (1 - lambda), kn = kt + lambda;
  const Springs springs = in_units_of_mu_d({kn, kn, 0}, {kt, kt, 0}, nu);
  const SelfCheck found = check(springs, Kinematics::rotational, nu);
  EXPECT_LT(found.C_error, 1e-14);  // the right elastic constants all the same
  EXPECT_LT(found.cell.least, 0);
  EXPECT_LT(found.zone.least, 0);
  EXPECT_EQ(found.verdict, Verdict::refuse);
  EXPECT_THAT(found.reason, HasSubstr("unstable: the wave with k d = ("));
  EXPECT_THAT(found.remedy, HasSubstr("isotropic"));
}

// Edges without shear stiffness hinge: nodes move without energy, the stiffness tensor is singular.
TEST(SelfCheck, MechanismIsRefused) {
  const SelfCheck found = check(in_units_of_mu_d({2, 0, 0}, {0, 0, 0}, 0), Kinematics::least_squares, 0);
  EXPECT_EQ(found.verdict, Verdict::refuse);
  EXPECT_TRUE(found.zone.soft_moves);
  EXPECT_THAT(found.reason, HasSubstr("nodes move without any energy"));
  EXPECT_FALSE(found.constants.has_value());
}

// Least-squares bending-exact springs at nu = -0.3: waves are stable (kn2 < 0 is outweighed), a lone cell is not.
TEST(SelfCheck, UnstableSurfacesAreRefused) {
  const auto springs = material::bending_exact_springs(rock(-0.3), d, Kinematics::least_squares);
  const SelfCheck found = check(springs, Kinematics::least_squares, -0.3);
  EXPECT_GT(found.zone.least, 0);
  EXPECT_NEAR(found.cell.least, -0.0641, 1e-4);
  EXPECT_EQ(found.verdict, Verdict::refuse);
  EXPECT_THAT(found.reason, HasSubstr("a single cell has a negative eigenvalue"));
}

// Full springs on one cell: edges four times, face diagonals twice the share of a bulk cell, so stiffer.
TEST(SelfCheck, PlainCellsKeepTheirFullSprings) {
  const auto springs = material::isotropic_springs(CellType::cube_ii, rock(0), d);
  const double mu = rock(0).mu();
  const CellModes shared = cell_modes(springs, d, Kinematics::rotational, Sharing::shared, mu);
  const CellModes plain = cell_modes(springs, d, Kinematics::rotational, Sharing::plain, mu);
  EXPECT_GT(plain.smallest_nonzero, 2 * shared.smallest_nonzero);
  EXPECT_LT(plain.smallest_nonzero, 4 * shared.smallest_nonzero);
}

}  // namespace
}  // namespace koshi::mechanics
