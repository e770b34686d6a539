// When bonds break (theory, section 12, "Bonds that break"): what cutting them costs, and a bond's limits.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "failure/bond_limits.h"
#include "koshi/calibration.h"

namespace koshi::failure {
namespace {

const material::Elastic granite{60e9, 0.2, 2700};

// Energy per area of a plane of normal n that opens along n: |D.n|/d^3 bonds of each slot, each broken at the stretch
// `stretch`, when its shear is tan(D, n) times as large.
double opened(const material::Springs& springs, double d, double stretch, const Vec3& n) {
  double energy = 0;
  for (const lattice::Slot& slot : lattice::slots) {
    const Vec3 D{d * slot.s[0], d * slot.s[1], d * slot.s[2]};
    const double along = dot(D, n), across = norm(D - along * n);
    if (std::abs(along) < 1e-9 * d) continue;
    const double stiffness = springs.kn[slot.family] + springs.kt[slot.family] * std::pow(across / along, 2);
    energy += std::abs(along) / (d * d * d) * 0.5 * stiffness * stretch * stretch * dot(D, D);
  }
  return energy;
}

// Planes along the cells take G_f. With t = kt/kn, in units of kn e^2/2, kn of an edge, Cube-III (springs as 1 : 1/2 :
// 3/16, energies as 1 : 1 : 9/16) takes
//   [100] 1 + 4 (1 + t) + 9/4 (1 + 2 t)                                                     =  7.25  +  8.5 t
//   [110] sqrt 2 (1 + t) + sqrt 2 + sqrt 8 (1 + 3 t) + 9/16 sqrt 8 (1 + t/2)                =  7.248 + 10.695 t
//   [111] sqrt 3 (1 + 2 t) + sqrt 12 (1 + t/2) + 9/16 sqrt 3 + 9/16 sqrt 3 (1 + 8 t)        =  7.145 + 12.990 t
// and Cube-II (equal springs, energies as 1 : 2) 9 + 8 t, sqrt 2 (1 + t) + 2 sqrt 2 + 2 sqrt 8 (1 + 3 t) = 9.899 +
// 18.385 t and sqrt 3 (1 + 2 t) + 2 sqrt 12 (1 + t/2) = 8.660 + 6.928 t. t = (1 - 4 nu)/(1 + nu): 1, 6/11, 1/6. This is
// the table of the theory.
TEST(BondLimits, PlanesAlongTheCellsTakeTheFractureEnergy) {
  const double r = 1 / std::numbers::sqrt2, s = std::numbers::inv_sqrt3;
  using enum lattice::CellType;
  for (const auto& [cell, nu, across_edge, across_corner] : {std::tuple{cube_iii, 0.0, 1.139, 1.278},
                                                             {cube_iii, 0.1, 1.101, 1.197},
                                                             {cube_iii, 0.2, 1.042, 1.074},
                                                             {cube_ii, 0.0, 1.664, 0.917},
                                                             {cube_ii, 0.1, 1.491, 0.931},
                                                             {cube_ii, 0.2, 1.255, 0.950}})
    for (const double d : {1e-3, 0.02}) {
      const material::Springs springs = material::isotropic_springs(cell, {60e9, nu, 2700}, d);
      const double e = critical_stretch(springs, 100);
      for (const Vec3& n : {Vec3{1, 0, 0}, {0, -1, 0}, {0, 0, 1}}) EXPECT_NEAR(opened(springs, d, e, n), 100, 1e-9);
      for (const Vec3& n : {Vec3{r, r, 0}, {r, 0, -r}, {0, r, r}})
        EXPECT_NEAR(opened(springs, d, e, n), 100 * across_edge, 0.06) << nu;
      for (const Vec3& n : {Vec3{s, s, s}, {s, -s, s}})
        EXPECT_NEAR(opened(springs, d, e, n), 100 * across_corner, 0.06) << nu;
      EXPECT_NEAR(springs.kt[0] / springs.kn[0], (1 - 4 * nu) / (1 + nu), 1e-12);
      const double t = springs.kt[0] / springs.kn[0], sum = cell == cube_iii ? 7.25 + 8.5 * t : 9 + 8 * t;
      EXPECT_NEAR(e / std::sqrt(200 / (sum * springs.kn[0])), 1, 1e-12);
    }
}

// Half the spacing: the springs are half as stiff, and the critical stretch is sqrt 2 times as large.
TEST(BondLimits, StrengthGoesWithTheRootOfTheSpacing) {
  const auto at = [](double d) {
    return critical_stretch(material::isotropic_springs(lattice::CellType::cube_iii, granite, d), 100);
  };
  EXPECT_NEAR(at(0.005) / at(0.01), std::numbers::sqrt2, 1e-12);
}

TEST(BondLimits, WhatIsGivenCounts) {
  const material::Springs springs = material::isotropic_springs(lattice::CellType::cube_iii, granite, 0.01);
  material::Fracture fracture;
  fracture.law = material::FractureLaw::bonds;
  fracture.fracture_energy = 100;
  BondLimits limits = bond_limits(fracture, springs);
  EXPECT_EQ(limits.stretch, critical_stretch(springs, 100));
  EXPECT_TRUE(std::isinf(limits.shear));
  fracture.critical_stretch = 2e-4;
  fracture.critical_shear = 5e-4;
  limits = bond_limits(fracture, springs);
  EXPECT_EQ(limits.stretch, 2e-4);
  EXPECT_EQ(limits.shear, 5e-4);
  // Shortened bonds break by shear only.
  EXPECT_EQ(broken(limits, 1.9e-4, 4.9e-4), Break::none);
  EXPECT_EQ(broken(limits, 2.1e-4, 0), Break::by_stretch);
  EXPECT_EQ(broken(limits, -1, 0), Break::none);
  EXPECT_EQ(broken(limits, -1, 5.1e-4), Break::by_shear);
  EXPECT_EQ(broken(limits, 2.1e-4, 5.1e-4), Break::by_stretch);
}

}  // namespace
}  // namespace koshi::failure
