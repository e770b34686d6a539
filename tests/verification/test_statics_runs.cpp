// The static solver against the other ways to the same equilibrium: the quasi-static run, and other numbers of ranks.
#include <gtest/gtest.h>

#include "driver/simulation.h"
#include "support/cases.h"
#include "support/first_ranks.h"
#include "support/state_bits.h"

namespace koshi {
namespace {

using material::Kinematics;
using Type = model::AnalysisDefinition::Type;
using Quantity = model::ProbeDefinition::Quantity;
using Reduce = model::ProbeDefinition::Reduce;

// A block with a soft corner and a hole, clamped below, pressed and pushed sideways above.
model::Definition body(const Int3& cells, Kinematics kinematics) {
  model::Definition definition = test::block(cells, 0.01, {3e9, 0.25, 2000});
  definition.lattice.kinematics = kinematics;
  definition.materials.push_back({"clay", {5e8, 0.4, 1800}});
  model::RegionDefinition corner, hole;
  corner.shape = model::RegionDefinition::Shape::box;
  corner.min = {0, 0, 0.02};
  corner.max = {0.03, 0.03, 0.05};
  corner.material = "clay";
  hole.shape = model::RegionDefinition::Shape::box;
  hole.min = {0.04, 0.02, 0.03};
  hole.max = {0.06, 0.04, 0.05};
  hole.material = "void";
  definition.regions = {corner, hole};
  definition.boundaries = {test::fixed("bottom", model::Face::z_min, {0, 1, 2, 3, 4, 5})};
  model::LoadDefinition load;
  load.name = "top";
  load.selection.face = model::Face::z_max;
  load.force = Vec3{300, -100, -900};
  definition.loads = {load};
  definition.probes = {test::probe("top", model::Face::z_max, Quantity::displacement, Reduce::area_mean),
                       test::probe("bottom", model::Face::z_min, Quantity::reaction, Reduce::sum)};
  definition.analysis.duration.reset();
  definition.analysis.damping = {};
  definition.analysis.type = Type::statics;
  definition.analysis.tolerance = 1e-11;
  return definition;
}

TEST(StaticRun, AgreesWithTheQuasiStaticRun) {
  if (Communicator::world().size() > 1) GTEST_SKIP() << "one rank is enough";
  for (const auto kinematics : {Kinematics::rotational, Kinematics::least_squares}) {
    model::Definition definition = body({7, 6, 8}, kinematics);
    driver::Simulation direct(definition, Communicator::world());
    direct.run({});
    definition.analysis.type = Type::quasi_static;
    definition.analysis.tolerance = 1e-7;
    driver::Simulation stepped(definition, Communicator::world());
    const driver::Outcome outcome = stepped.run({});
    EXPECT_TRUE(outcome.converged);
    EXPECT_GT(outcome.steps, 100);

    // Displacements and rotations each against their own size.
    int checked = 0;
    for (int first = 0; first < direct.model().components(); first += 3) {
      double largest = 0, difference = 0;
      for (int c = first; c < first + 3; ++c)
        lattice::for_each_owned(direct.model().layout(), [&](auto, auto, auto, auto n) {
          const double u = direct.state().displacement.component(c)[n];
          largest = std::max(largest, std::abs(u));
          difference = std::max(difference, std::abs(u - stepped.state().displacement.component(c)[n]));
          ++checked;
        });
      EXPECT_GT(largest, 1e-6);
      EXPECT_GT(difference, 0);
      EXPECT_LT(difference, 1e-5 * largest) << "component " << first;
    }
    EXPECT_EQ(checked, 8 * 7 * 9 * direct.model().components());
  }
}

// Large enough for several levels, the last ones gathered on every rank; odd numbers of cells.
TEST(StaticRun, IsTheSameOnAnyNumberOfRanks) {
  const int world = Communicator::world().size();
  std::vector<driver::Outcome> outcomes;
  std::vector<std::vector<std::int64_t>> sums;
  for (const int ranks : {1, world}) {
    const auto group = test::first_ranks(ranks);
    if (!group) continue;
    model::Definition definition = body({41, 19, 37}, Kinematics::rotational);
    // An island in a hole between the ranks.
    model::RegionDefinition hole, island;
    hole.shape = island.shape = model::RegionDefinition::Shape::box;
    hole.min = {0.15, 0.05, 0.1};
    hole.max = {0.25, 0.15, 0.2};
    hole.material = "void";
    island.min = {0.17, 0.07, 0.12};
    island.max = {0.23, 0.13, 0.18};
    island.material = "clay";
    definition.regions.push_back(hole);
    definition.regions.push_back(island);
    driver::Simulation simulation(definition, *group);
    outcomes.push_back(simulation.run({}));
    sums.push_back(test::bits_of(simulation));
    const statics::SolveReport& report = *outcomes.back().solution;
    EXPECT_EQ(report.projected_motions, 6);
    EXPECT_LE(report.relative_residual, 1e-11);
    EXPECT_LE(report.iterations, 30);
    // Reactions balance the loads.
    EXPECT_NEAR(outcomes.back().measurement.probes[1][0], -300, 1e-6);
    EXPECT_NEAR(outcomes.back().measurement.probes[1][2], 900, 1e-6);
  }
  if (outcomes.size() < 2) return;
  EXPECT_EQ(outcomes[0].solution->free_motions, outcomes[1].solution->free_motions);
  EXPECT_EQ(outcomes[0].solution->residual_history, outcomes[1].solution->residual_history);
  EXPECT_EQ(outcomes[0].measurement.probes, outcomes[1].measurement.probes);
  EXPECT_EQ(sums[0], sums[1]);
}

}  // namespace
}  // namespace koshi
