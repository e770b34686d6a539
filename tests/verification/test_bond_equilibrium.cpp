// Bonds that break in equilibrium (theory, section 12, "Bonds in equilibrium"): bars whose every event and step follows
// from the bond law.
//
// A bar of 16 layers, periodic across, of which one breaks: all layers stay plane, and by uniaxial strain edges break
// at e_c, face diagonals at 2 e_c, body diagonals at 3 e_c of the layer's strain. With stiffnesses as 1 : 1/2 : 3/16
// and t = kt/kn = 1/6, of M = 9/4 + 3/2 t = 2.5 (in kn/d of an edge) the bonds left then carry 5/4 + 3/2 t = 1.5 = 0.6
// M and 1/4 + t/2 = 1/3 = 0.4/3 M. In units of M e_c A of force and e_c d of motion the layer breaks at the forces 1, 2
// 0.6 = 1.2 and 3 0.4/3 = 0.4, where the layer has opened by 1, 2, 3 and the other 15 layers by 15 times the force:
// ends move by 16, 20 and 9. When nothing is left the force is 0 at 3.
#include <gtest/gtest.h>

#include <cmath>

#include "support/breaking_block.h"
#include "support/cracking_bar.h"

namespace koshi {
namespace {

using test::energy_gap;
using test::follow_cracks;
using test::Followed;

constexpr double d = 0.005, area = 1e-4;
// E = 60 GPa and nu = 0.2: mu = 25 GPa, kn = 16/15 mu d of an edge, M = 2.5 kn/d = 66.7 GPa, and 100 J/m^2 = (7.25
// + 8.5 t) kn e_c^2/2.
const double kn = 16.0 / 15 * 25e9 * d, M = 2.5 * kn / d, e_c = std::sqrt(200 / ((7.25 + 8.5 / 6) * kn));
const double force = M * e_c * area, motion = e_c * d;

model::Definition bar() {
  model::Definition definition = test::bar_with_weak_layer();
  definition.body.periodic = {false, true, true};
  model::BoundaryDefinition pull = test::fixed("pull", model::Face::x_max, {1, 2, 3, 4, 5});
  pull.displacement[0] = 100 * motion;
  definition.boundaries = {test::fixed("wall", model::Face::x_min, {0, 1, 2, 3, 4, 5}), pull};
  definition.analysis = {};
  definition.analysis.type = model::AnalysisDefinition::Type::statics;
  definition.analysis.tolerance = 1e-9;
  return definition;
}

// Steps through a motion of the end, in its unit, that goes from 0 to each of these in a second.
model::Definition stepped(std::initializer_list<double> motions, int steps) {
  model::Definition definition = bar();
  model::History history{{0, 0}};
  for (const double to : motions) history.push_back({history.back()[0] + 1, to / 100});
  definition.boundaries[1].history = history;
  definition.analysis.steps = steps;
  return definition;
}

// Each group of bonds breaks at the force and the motion above, and the load falls to where the layer is open as far as
// it was: the force of the bonds that are left, 0.6, 3/4 of 0.4 ... at the same opening. In all they take G_f, what
// they hold at their limits; the last but one of these points is behind the one before, which no motion of the end
// could follow. (That bonds break together that are within a thousandth of their limit does not show: these are alike.)
TEST(BondEvents, EachFollowsFromTheBondLaw) {
  const Followed seen = follow_cracks(bar());
  // Opening and force before and after each break: the bonds that are left carry 0.6 of the strain, then 0.4/3.
  const double points[][2] = {{1, 1}, {1, 0.6}, {2, 1.2}, {2, 0.8 / 3}, {3, 0.4}, {3, 0}};
  ASSERT_EQ(seen.rows.size(), 7u);
  for (std::size_t at = 0; at < 6; ++at) {
    const auto& [opening, of_force] = points[at];
    EXPECT_NEAR(seen.rows[at + 1].force / force, of_force, 1e-5) << at;
    EXPECT_NEAR(100 * seen.rows[at + 1].factor, opening + 15 * of_force, 1e-4) << at;
  }
  EXPECT_NEAR(seen.rows.back().balance.cracked / (100 * area), 1, 1e-5);
  EXPECT_LT(energy_gap(seen), 1e-6);
  EXPECT_EQ(seen.outcome.path->reason, "the body has parted");
  EXPECT_EQ(seen.outcome.path->peak_event, 3);
  EXPECT_EQ(seen.outcome.path->cracked, 4);
  EXPECT_EQ(seen.outcome.path->parted, 4);
}

// The same under a force of half the first one: factors are forces.
TEST(BondEvents, LoadsAreScaled) {
  model::Definition definition = bar();
  definition.boundaries.pop_back();
  model::LoadDefinition load;
  load.name = "pull";
  load.selection.face = model::Face::x_max;
  load.traction = Vec3{0.5 * force / area, 0, 0};
  definition.loads = {load};
  definition.probes.clear();
  const Followed seen = follow_cracks(definition);
  EXPECT_NEAR(seen.outcome.path->peak_load_factor, 2.4, 1e-4);
  EXPECT_EQ(seen.outcome.path->reason, "the body has parted");
  EXPECT_NEAR(seen.rows.back().balance.cracked / (100 * area), 1, 1e-4);
  EXPECT_LT(energy_gap(seen), 1e-6);
}

TEST(BondEvents, WithoutLimitsItIsTheEquilibrium) {
  model::Definition definition = bar();
  definition.boundaries[1].displacement[0] = -motion;
  const Followed seen = follow_cracks(definition);
  ASSERT_EQ(seen.rows.size(), 2u);
  EXPECT_EQ(seen.outcome.path->reason, "nothing cracks any more");
  EXPECT_NEAR(seen.rows[1].force / force, -1 / 16.0, 1e-8);
  EXPECT_EQ(seen.outcome.path->cracked, 0);
}

// Force of a step from the motion of the end: edges hold up to 16, face diagonals up to 20 with 0.6 of the layer's
// stiffness, and beyond it nothing is left.
double expected_force(double end) {
  if (end < 16) return end / 16;
  return end < 20 ? end / (1 / 0.6 + 15) : 0;
}

// Steps of 0.75, of which none ends within a hundredth of a limit.
TEST(BondSteps, EachFollowsFromTheBondLaw) {
  const Followed seen = follow_cracks(stepped({30}, 40));
  ASSERT_EQ(seen.rows.size(), 41u);
  for (std::size_t at = 0; at <= 40; ++at)
    EXPECT_NEAR(seen.rows[at].force / force, expected_force(0.75 * static_cast<double>(at)), 1e-4) << at;
  EXPECT_LT(energy_gap(seen), 1e-6);
  // The work up to there: triangles of force over motion, and what the bar gives back as it parts.
  EXPECT_GT(seen.rows.back().balance.cracked, 100 * area);
  EXPECT_EQ(seen.outcome.path->parted, 4);
}

// Broken bonds that are shortened carry pressure by their normal springs: without the shear springs 1 + 1 + 1/4 = 9/4
// of M = 2.5 in the layer. Pulled again they carry nothing, and energies add up on the way to and fro.
TEST(BondSteps, FacesCarryPressureAfterBreaking) {
  const Followed seen = follow_cracks(stepped({30, -4, 4}, 60));
  ASSERT_EQ(seen.rows.size(), 61u);
  int pressed = 0, open = 0;
  for (std::size_t at = 28; at <= 60; ++at) {
    const double end = at <= 20   ? 1.5 * static_cast<double>(at)
                       : at <= 40 ? 30 - 1.7 * static_cast<double>(at - 20)
                                  : -4 + 0.4 * static_cast<double>(at - 40);
    EXPECT_NEAR(seen.rows[at].force / force, end < 0 ? end / (2.5 / 2.25 + 15) : 0, 1e-4) << at;
    (end < -1e-9 ? pressed : open) += 1;
  }
  EXPECT_EQ(pressed, 12);
  EXPECT_EQ(open, 21);
  EXPECT_LT(energy_gap(seen), 1e-6);
}

// A crack from the start, pushed: the same pressure, event by event; pulled apart it carries the trace.
TEST(BondEvents, CracksFromTheStartCarryPressure) {
  for (const double end : {-1.0, 1.0}) {
    model::Definition definition = bar();
    model::CrackDefinition crack;
    crack.shape = model::CrackDefinition::Shape::rectangle;
    crack.center = {0.0425, 0, 0};
    crack.normal = {1, 0, 0};
    crack.along = {0, 1, 0};
    crack.length = crack.width = 1;
    definition.pre_cracks = {crack};
    definition.boundaries[1].displacement[0] = end * motion;
    const Followed seen = follow_cracks(definition);
    ASSERT_GE(seen.rows.size(), 2u);
    EXPECT_NEAR(seen.rows[1].force / force, end < 0 ? end / (2.5 / 2.25 + 15) : 1e-6, 2e-7);
    EXPECT_LT(energy_gap(seen), 1e-6);
  }
}

// Under a force that grows, nothing is left to carry it beyond 1.2: the run ends at the step before, with its cracks.
TEST(BondSteps, BodiesUnderLoadsPart) {
  model::Definition definition = bar();
  definition.boundaries.pop_back();
  model::LoadDefinition load;
  load.name = "pull";
  load.selection.face = model::Face::x_max;
  load.traction = Vec3{1.99 * force / area, 0, 0};
  load.history = {{0, 0}, {1, 1}};
  definition.loads = {load};
  definition.probes.clear();
  definition.analysis.steps = 20;  // 1.99 12/20 = 1.194 is carried still, 1.99 13/20 = 1.29 is not
  const Followed seen = follow_cracks(definition);
  ASSERT_EQ(seen.rows.size(), 13u);
  EXPECT_EQ(seen.outcome.path->reason, "the body has parted in step 13");
  EXPECT_EQ(seen.outcome.path->parted, 0);
  EXPECT_EQ(seen.outcome.path->cracked, 4);
  EXPECT_LT(energy_gap(seen), 1e-6);
}

}  // namespace
}  // namespace koshi
