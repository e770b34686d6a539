// Cracks in equilibrium (theory, section 12, "In equilibrium"): bars give the strength and the energy asked for through
// snap-back, and energies add up to the work at every event.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "failure/softening.h"
#include "support/cracking_bar.h"

namespace koshi {
namespace {

using enum material::Kinematics;
using test::cracking_bar;
using test::CrackRow;
using test::energy_gap;
using test::follow_cracks;
using test::Followed;

// The layer cracks at f_t and takes G_f for its area of 1 cm^2 until it has parted, for all spacings and both
// softenings, to a thousandth of the strength (cells within a thousandth crack together) and half a per cent of the
// energy (cells break at 0.4 % of their strength, where exponential softening has 0.4 % to go). Nodes with rotations of
// their own turn along the crack's edges: 2 to 3 % with two cells across (theory, section 12).
TEST(CrackEvents, BarsTakeStrengthAndEnergy) {
  using enum material::Softening;
  int bars = 0;
  for (const auto softening : {linear, exponential})
    for (const auto& [kinematics, d] :
         {std::pair{least_squares, 0.01}, {least_squares, 0.005}, {least_squares, 0.0025}, {rotational, 0.005}}) {
      const Followed seen = follow_cracks(cracking_bar(d, kinematics, softening));
      double peak = 0;
      for (const CrackRow& row : seen.rows) peak = std::max(peak, row.force);
      const bool turns = kinematics == rotational;
      EXPECT_NEAR(peak / (1e-4 * 3e6), turns ? 1.025 : 1, turns ? 0.007 : 1e-3) << d;
      EXPECT_NEAR(seen.rows.back().balance.cracked / (1e-4 * 100), 1, 5e-3) << d;
      EXPECT_LT(energy_gap(seen), 1e-6) << d;
      EXPECT_EQ(seen.outcome.path->reason, "the body has parted") << d;
      const auto layer = static_cast<std::int64_t>(std::pow(std::llround(0.01 / d), 2));
      EXPECT_EQ(seen.outcome.path->cracked, layer);
      EXPECT_EQ(seen.outcome.path->parted, layer);
      // u at the strength: 3e6/30e9 80 mm = 8 um of the 100 um.
      EXPECT_NEAR(seen.rows[1].factor, 0.08, turns ? 0.003 : 1e-4);
      ++bars;
    }
  EXPECT_EQ(bars, 8);
}

// With a tenth of the energy and a strength of 10 MPa the bar is 80 mm long and l_ch = E G_f/f_t^2 = 3 mm: it stores
// 80/(2 3) times what its crack takes, and force and displacement go back together. In cells of 2.5 mm < 2 l_ch the
// strength is kept.
TEST(CrackEvents, PassSnapBack) {
  model::Definition definition = cracking_bar(0.0025, least_squares, material::Softening::linear);
  definition.materials[1].fracture->tensile_strength = 10e6;
  definition.materials[1].fracture->fracture_energy = 10;
  const Followed seen = follow_cracks(definition);
  ASSERT_GT(seen.rows.size(), 10u);
  EXPECT_NEAR(seen.rows[1].force / (1e-4 * 10e6), 1, 1e-3);
  EXPECT_NEAR(seen.rows.back().balance.cracked / (1e-4 * 10), 1, 0.01);
  EXPECT_LT(energy_gap(seen), 1e-6);
  int back = 0;
  for (std::size_t r = 2; r < seen.rows.size(); ++r)
    back += seen.rows[r].factor < 0.5 * seen.rows[1].factor && seen.rows[r].force > 0.01 * seen.rows[1].force;
  EXPECT_GT(back, 2);
}

// Nothing cracks in a bar that is pressed: the answer is that of the equilibrium without a fracture, at factor 1.
TEST(CrackEvents, WithoutCracksItIsTheEquilibrium) {
  model::Definition definition = cracking_bar(0.005, least_squares, material::Softening::linear);
  definition.boundaries[1].displacement[0] = -1e-4;
  const Followed seen = follow_cracks(definition);
  ASSERT_EQ(seen.rows.size(), 2u);
  EXPECT_EQ(seen.outcome.path->reason, "nothing cracks any more");
  EXPECT_EQ(seen.rows[0].force, 0);
  EXPECT_EQ(seen.rows[1].factor, 1);
  EXPECT_NEAR(seen.rows[1].force, -30e9 * 1e-4 * 1e-4 / 0.08, 1e-6 * 3750);
  EXPECT_EQ(seen.outcome.path->cracked, 0);
}

// A bar under a given force is the same bar: its factor peaks with the strength, and its stiffness falls.
TEST(CrackEvents, LoadsAreScaled) {
  model::Definition definition = test::loaded_bar(material::Softening::exponential, 2e6, {{0, 0}, {1, 0.5}});
  const Followed seen = follow_cracks(definition);
  EXPECT_NEAR(seen.outcome.path->peak_load_factor, 3, 3e-3);
  EXPECT_EQ(seen.outcome.path->reason, "the body has parted");
  EXPECT_NEAR(seen.rows.back().balance.cracked / (1e-4 * 100), 1, 5e-3);
  EXPECT_LT(energy_gap(seen), 1e-6);
}

TEST(CrackEvents, EndAtTheNumberAskedFor) {
  model::Definition definition = cracking_bar(0.005, least_squares, material::Softening::exponential);
  definition.analysis.events = 3;
  const Followed seen = follow_cracks(definition);
  EXPECT_EQ(seen.rows.size(), 4u);
  EXPECT_EQ(seen.outcome.path->reason, "number of events");
}

// (1 - omega) y meets S(D) on the line of linear softening whatever the tooth, if the strain of the cell follows: S =
// (R - y)/(R - 1) with y = S/s. A tooth at s from the tip at s' takes (s' - s) y' y.
TEST(CrackEvents, TeethOfABarLieOnTheLine) {
  const double R = 20;
  const failure::Softening law(material::Softening::linear, R);
  double before = 1, y = 1, taken = 0;
  for (const double left : {0.7, 0.2, 0.1, 0.01}) {
    // At the unit factor y = 1 by choice; the factor found is the next y.
    const double next = law.reach(taken, (before - left) * y, left);
    EXPECT_NEAR(left * next, (R - next) / (R - 1), 1e-12) << left;
    taken += (before - left) * y * next;
    EXPECT_NEAR(taken, R * (1 - left * next), 1e-10);
    y = next;
    before = left;
  }
  // What is left is taken when the cell has broken, at y = R.
  EXPECT_NEAR(law.reach(taken, before * y, 0), R, 1e-9);
  EXPECT_TRUE(std::isinf(law.reach(taken, 0, 0)));
}

}  // namespace
}  // namespace koshi
