// Cracks in equilibrium in steps of the loads (theory, section 12, "In steps"): bars give the strength and the energy
// asked for, force follows the law's curve, and energies add up to the work in every step.
#include "support/cracking_bar.h"

namespace koshi {
namespace {

using enum material::Kinematics;
using test::cracking_bar;
using test::CrackRow;
using test::energy_gap;
using test::follow_cracks;
using test::Followed;

// The bar pulled by `motion` [m] in a second, in equal steps.
model::Definition stepped(model::Definition definition, double motion, int steps) {
  definition.boundaries[1].displacement[0] = motion;
  definition.boundaries[1].history = {{0, 0}, {1, 1}};
  definition.analysis.steps = steps;
  return definition;
}

// The layer cracks at f_t and takes G_f for its area of 1 cm^2. A step of 0.8 um is a tenth of the 8 um at which the
// bar is at its strength, so that one is there; the exponential law has 1 % to go at 0.6 mm. Nodes with rotations turn
// along the crack's edges (2.5 %).
TEST(CrackSteps, BarsTakeStrengthAndEnergy) {
  using enum material::Softening;
  int bars = 0;
  for (const auto softening : {linear, exponential})
    for (const auto& [kinematics, d] : {std::pair{least_squares, 0.01}, {least_squares, 0.005}, {rotational, 0.005}}) {
      const bool line = softening == linear, turns = kinematics == rotational;
      const Followed seen =
          follow_cracks(stepped(cracking_bar(d, kinematics, softening), line ? 1e-4 : 6e-4, line ? 125 : 750));
      double peak = 0;
      for (const CrackRow& row : seen.rows) peak = std::max(peak, row.force);
      EXPECT_NEAR(peak / (1e-4 * 3e6), turns ? 1.02 : 1, turns ? 0.015 : 5e-3) << d;
      EXPECT_NEAR(seen.rows.back().balance.cracked / (1e-4 * 100), 1, 0.01) << d;
      EXPECT_LT(energy_gap(seen), 1e-6) << d;
      EXPECT_EQ(seen.outcome.path->reason, "the end of the histories");
      const auto layer = static_cast<std::int64_t>(std::pow(std::llround(0.01 / d), 2));
      EXPECT_EQ(seen.outcome.path->cracked, layer);
      EXPECT_EQ(seen.rows.size(), line ? 126u : 751u);
      EXPECT_EQ(seen.rows[0].force, 0);
      ++bars;
    }
  EXPECT_EQ(bars, 6);
}

// In series with L - d of whole bar, a layer whose stress has fallen to S f_t has the strain (R - (R - 1) S) f_t/E,
// with R = 2 E G_f/(d f_t^2) = 133: the end has moved by S f_t/E (L - d) + d (R - (R - 1) S) f_t/E. Steps of 2.5 um lie
// on that line to 1.5 % of f_t: what a layer takes is that of the straight line between two of them.
TEST(CrackSteps, ForceFollowsTheCurve) {
  const Followed seen =
      follow_cracks(stepped(cracking_bar(0.005, least_squares, material::Softening::linear), 1e-4, 40));
  const double strain = 3e6 / 30e9, d = 0.005, R = 2 * 30e9 * 100 / (d * 9e12);
  int after = 0;
  for (const CrackRow& row : seen.rows) {
    const double u = 1e-4 * row.time;
    const double S = (R * d * strain - u) / (strain * ((R - 1) * d - (0.08 - d)));
    const double expected = u < 0.08 * strain ? u / (0.08 * strain) : std::max(S, 0.0);
    EXPECT_NEAR(row.force / 300, expected, 0.015) << u;
    after += S < 1 && S > 0 ? 1 : 0;
  }
  EXPECT_GT(after, 20);
}

// Pulled by 30 um, pressed by 10 and pulled on: the crack closes, carries 30 GPa 10 um/80 mm 1 cm^2 = 375 N as the
// whole bar would, opens again on its secant and takes no more than G_f in all.
TEST(CrackSteps, CracksCloseAndOpen) {
  model::Definition definition = stepped(cracking_bar(0.005, least_squares, material::Softening::linear), 1e-4, 100);
  definition.boundaries[1].history = {{0, 0}, {1, 0.3}, {2, -0.1}, {3, 0.3}, {5, 1}};
  const Followed seen = follow_cracks(definition);
  ASSERT_EQ(seen.rows.size(), 101u);
  EXPECT_NEAR(seen.rows[40].force, -375, 1e-3);
  EXPECT_EQ(seen.rows[40].balance.cracked, seen.rows[21].balance.cracked) << "nothing cracks on the way back";
  EXPECT_GT(seen.rows[20].balance.cracked, 1e-3);
  // Secant: the force at 20 um on the way up is that on the way down.
  EXPECT_NEAR(seen.rows[25].force, seen.rows[55].force, 0.01);
  EXPECT_GT(seen.rows[25].force, 100);
  EXPECT_NEAR(seen.rows.back().balance.cracked / (1e-4 * 100), 1, 0.01);
  EXPECT_LT(energy_gap(seen), 1e-6);
}

// Held at no load, the bar is at rest but for rounding, of which its equilibria keep none of the digits: a right-hand
// side that has gone back to nothing, or to the last digit of what it was, has no size by which to judge them.
TEST(CrackSteps, UnloadedBodiesRest) {
  for (const double rest : {0.0, 1e-17, -1e-17, 3e-19}) {
    model::Definition definition = stepped(cracking_bar(0.005, least_squares, material::Softening::linear), 1e-4, 40);
    definition.boundaries[1].history = {{0, 0}, {1, 0.3}, {2, rest}, {3, rest}, {4, 0.3}};
    const Followed seen = follow_cracks(definition);
    ASSERT_EQ(seen.rows.size(), 41u) << rest;
    for (std::size_t row = 20; row <= 30; ++row) EXPECT_NEAR(seen.rows[row].force, 0, 1e-9 * 300) << rest;
    EXPECT_NEAR(seen.rows[40].force, seen.rows[10].force, 1e-6 * 300) << rest;
    EXPECT_EQ(seen.rows[40].balance.cracked, seen.rows[11].balance.cracked) << rest;
    EXPECT_GT(seen.rows[10].balance.cracked, 1e-3) << rest;
  }
}

// Under a given force nothing holds the bar beyond its strength of 300 N: it parts in the first step above it, and the
// last row is that of the step before.
TEST(CrackSteps, BodiesUnderLoadsPart) {
  model::Definition definition = test::loaded_bar(material::Softening::exponential, 4e6, {{0, 0}, {1, 1}});
  definition.analysis.steps = 50;
  const Followed seen = follow_cracks(definition);
  EXPECT_EQ(seen.outcome.path->reason, "the body has parted in step 38");
  ASSERT_EQ(seen.rows.size(), 38u);
  EXPECT_NEAR(seen.rows.back().time, 37 / 50., 1e-12);
  // f^2/(2 E) of 2.96 MPa on 8 cm^3.
  EXPECT_NEAR(seen.outcome.measurement.balance.elastic_energy, 2.96e6 * 2.96e6 / 60e9 * 8e-6, 1e-7 * 1e-3);
}

// A bar that stores f_t^2/(2 E) 8 cm^3 = 13.3 mJ, 13 times what its crack takes, snaps back: the step in which it
// breaks takes all of that from it.
TEST(CrackSteps, JumpOverSnapBack) {
  model::Definition definition = cracking_bar(0.0025, least_squares, material::Softening::linear);
  definition.materials[1].fracture->tensile_strength = 10e6;
  definition.materials[1].fracture->fracture_energy = 10;
  const Followed seen = follow_cracks(stepped(definition, 1e-4, 50));
  EXPECT_NEAR(seen.rows.back().balance.cracked, 13.6e-3, 0.5e-3);
  EXPECT_LT(energy_gap(seen), 1e-6);
  int between = 0;
  for (const CrackRow& row : seen.rows) between += row.time > 0.3 && row.force > 5 && row.force < 950 ? 1 : 0;
  EXPECT_EQ(between, 0);
}

// The answer without cracks is that of the equilibrium, step by step.
TEST(CrackSteps, WithoutCracksTheyAreEquilibria) {
  model::Definition definition = stepped(cracking_bar(0.005, least_squares, material::Softening::linear), -1e-4, 4);
  const Followed seen = follow_cracks(definition);
  ASSERT_EQ(seen.rows.size(), 5u);
  for (std::size_t row = 0; row < 5; ++row)
    EXPECT_NEAR(seen.rows[row].force, -30e9 * 1e-4 * 1e-4 / 0.08 * static_cast<double>(row) / 4, 1e-6 * 3750);
  EXPECT_EQ(seen.outcome.path->cracked, 0);
}

}  // namespace
}  // namespace koshi
