// Bodies that are held too little: every combination of free motions is found, said, and left out of the solution.
#include <gmock/gmock.h>

#include <bit>
#include <bitset>
#include <set>

#include "driver/simulation.h"
#include "support/cases.h"

namespace koshi {
namespace {

using material::Kinematics;

constexpr double d = 0.01;

/// Six supports at three nodes, of which any five leave exactly one motion free: x, y, z at the corner, y, z at the
/// corner beyond it along x, z at the one along y. The axes may be turned: x, y, z stands for axis, axis + 1, axis + 2.
struct Support {
  int along;      ///< corner: -1 the first, else the one beyond it along this axis
  int component;  ///< that is held
};
constexpr std::array<Support, 6> supports{{{-1, 0}, {-1, 1}, {-1, 2}, {0, 1}, {0, 2}, {1, 2}}};

/// Adds those of the six supports whose bits are set, to the box of cells that begins at `base`.
void hold(model::Definition& definition, unsigned chosen, std::size_t axis, const Int3& base, const Int3& cells) {
  for (std::size_t s = 0; s < supports.size(); ++s) {
    if ((chosen >> s & 1) == 0) continue;
    Vec3 at;
    for (std::size_t a = 0; a < 3; ++a) at[a] = d * static_cast<double>(base[a]);
    if (supports[s].along >= 0) {
      const std::size_t along = (axis + static_cast<std::size_t>(supports[s].along)) % 3;
      at[along] += d * static_cast<double>(cells[along]);
    }
    model::BoundaryDefinition boundary;
    boundary.name = "support " + std::to_string(definition.boundaries.size());
    boundary.selection.point = at;
    boundary.fix[(axis + static_cast<std::size_t>(supports[s].component)) % 3] = true;
    definition.boundaries.push_back(boundary);
  }
}

/// Axes along which the body may move: those of which no support holds the component.
std::set<std::size_t> free_axes(unsigned chosen, std::size_t axis) {
  std::set<std::size_t> axes{0, 1, 2};
  for (std::size_t s = 0; s < supports.size(); ++s)
    if (chosen >> s & 1) axes.erase((axis + static_cast<std::size_t>(supports[s].component)) % 3);
  return axes;
}

/// A block pulled along x from both ends.
model::Definition pulled(const Int3& cells, Kinematics kinematics) {
  model::Definition definition = test::block(cells, d, {3e9, 0.25, 2000});
  definition.analysis = {};
  definition.lattice.kinematics = kinematics;
  for (const auto& [face, name] : {std::pair{model::Face::x_min, "west"}, {model::Face::x_max, "east"}}) {
    model::LoadDefinition load;
    load.name = name;
    load.selection.face = face;
    load.pressure = -1e6;
    definition.loads.push_back(load);
  }
  return definition;
}

/// The words after "is free to" in "move along ... and rotate about ...": how many axes each list names.
std::pair<int, int> axes_named(const std::string& text) {
  const auto count = [](const std::string& list) {
    int axes = 0, inside = 0;
    for (const char c : list) {
      inside += (c == '(') - (c == ')');
      axes += c == '(' || (inside == 0 && c >= 'x' && c <= 'z');
    }
    return axes;
  };
  const std::size_t moves = text.find("move along "), turns = text.find("rotate about ");
  std::string moving, turning;
  if (moves != std::string::npos)
    moving = text.substr(moves + 11, turns == std::string::npos ? turns : turns - 5 - moves - 11);
  if (turns != std::string::npos) turning = text.substr(turns + 13);
  return {count(moving), count(turning)};
}

/// Whatever five of the six supports are missing, the body is stretched alike, and its free axes do not move on the
/// whole.
TEST(FreeMotions, EveryCombinationOfSupportsGivesTheSameStretch) {
  const Int3 cells{4, 3, 5};
  int combinations = 0, with_motions = 0;
  for (const auto kinematics : {Kinematics::rotational, Kinematics::least_squares}) {
    double energy = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (unsigned chosen = 64; chosen-- > 0;) {
        SCOPED_TRACE(testing::Message() << "supports " << std::bitset<6>(chosen) << ", axis " << axis);
        model::Definition definition = pulled(cells, kinematics);
        hold(definition, chosen, axis, {0, 0, 0}, cells);
        driver::Simulation simulation(definition, Communicator::world());
        const driver::Outcome outcome = simulation.run({});
        const statics::SolveReport& report = *outcome.solution;

        // The six supports are independent: each holds one motion.
        const std::set<std::size_t> axes = free_axes(chosen, axis);
        ASSERT_EQ(report.projected_motions, 6 - std::popcount(chosen));
        const auto [moves, turns] = axes_named(report.free_motions);
        EXPECT_EQ(moves, axes.size()) << report.free_motions;
        EXPECT_EQ(turns, 6 - std::popcount(chosen) - static_cast<int>(axes.size())) << report.free_motions;
        for (const std::size_t a : axes)
          EXPECT_NE(report.free_motions.substr(0, report.free_motions.find("rotate")).find(std::string{' ', "xyz"[a]}),
                    std::string::npos)
              << report.free_motions;

        // Statically determinate or less: supports bear nothing. With least squares the stretch is uniform and the
        // energy that of stress p, p^2 V/(2 E); rotations are freer at edges, by the same amount in all combinations.
        if (energy == 0) energy = outcome.measurement.balance.elastic_energy;
        if (kinematics == Kinematics::least_squares) EXPECT_NEAR(energy / (1e12 / 6e9 * 60 * d * d * d), 1, 1e-6);
        EXPECT_NEAR(outcome.measurement.balance.elastic_energy / energy, 1, 1e-6);
        std::array<double, 3> sum{};
        lattice::for_each_owned(simulation.model().layout(), [&](auto, auto, auto, auto n) {
          for (std::size_t a = 0; a < 3; ++a)
            sum[a] += simulation.state().displacement.component(static_cast<int>(a))[n];
        });
        for (const std::size_t a : axes)
          EXPECT_NEAR(simulation.model().communicator.sum(static_cast<std::int64_t>(std::llround(sum[a] * 1e15))), 0,
                      1e5);

        ++combinations;
        with_motions += !report.free_motions.empty();
      }
  }
  EXPECT_EQ(combinations, 2 * 3 * 64);
  EXPECT_EQ(with_motions, 2 * 3 * 63);
}

/// A pull at one corner, askew: no equilibrium unless all is held, and the message names what is free.
TEST(FreeMotions, EveryUnbalancedCombinationIsRefused) {
  const Int3 cells{4, 3, 5};
  int refused = 0;
  for (const auto kinematics : {Kinematics::rotational, Kinematics::least_squares})
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (unsigned chosen = 0; chosen < 64; ++chosen) {
        SCOPED_TRACE(testing::Message() << "supports " << std::bitset<6>(chosen) << ", axis " << axis);
        model::Definition definition = pulled(cells, kinematics);
        hold(definition, chosen, axis, {0, 0, 0}, cells);
        model::LoadDefinition load;
        load.name = "askew";
        load.selection.point = Vec3{4 * d, 3 * d, 5 * d};
        load.force = Vec3{1, 3, 7};
        definition.loads = {load};
        driver::Simulation simulation(definition, Communicator::world());
        if (chosen == 63) {
          EXPECT_EQ(simulation.run({}).solution->projected_motions, 0);
          continue;
        }
        try {
          simulation.run({});
          ADD_FAILURE() << "the pull moves the body";
        } catch (const InputError& error) {
          EXPECT_THAT(error.what(), testing::HasSubstr("is free to "));
          EXPECT_THAT(error.what(), testing::HasSubstr("its loads do not balance"));
          ++refused;
        }
      }
  EXPECT_EQ(refused, 2 * 3 * 63);
}

/// Two blocks above each other with a gap between, each held in its own way.
TEST(FreeMotions, TwoBodiesHaveTheirOwn) {
  const Int3 cells{4, 3, 2};
  int checked = 0;
  for (unsigned lower = 0; lower < 64; lower += 3)
    for (const unsigned upper : {63u - lower, lower, 0u, 63u}) {
      SCOPED_TRACE(testing::Message() << "supports " << std::bitset<6>(lower) << ", " << std::bitset<6>(upper));
      model::Definition definition = pulled({4, 3, 5}, Kinematics::rotational);
      model::RegionDefinition gap;
      gap.shape = model::RegionDefinition::Shape::box;
      gap.min = {0, 0, 2 * d};
      gap.max = {4 * d, 3 * d, 3 * d};
      gap.material = "void";
      definition.regions = {gap};
      hold(definition, lower, 0, {0, 0, 0}, cells);
      hold(definition, upper, 1, {0, 0, 3}, cells);
      driver::Simulation simulation(definition, Communicator::world());
      const driver::Outcome outcome = simulation.run({});
      EXPECT_EQ(outcome.solution->projected_motions, 12 - std::popcount(lower) - std::popcount(upper));
      const std::string& text = outcome.solution->free_motions;
      EXPECT_EQ(text.find("part 1 of 2") != std::string::npos, lower != 63) << text;
      EXPECT_EQ(text.find("part 2 of 2") != std::string::npos, upper != 63) << text;
      EXPECT_LE(outcome.solution->relative_residual, 1e-8);
      ++checked;
    }
  EXPECT_EQ(checked, 22 * 4);
}

/// Large enough for several levels, which must not lose hold of it: a bar on a hinge along an edge, askew and straight.
TEST(FreeMotions, AHingeIsSaidWithItsAxis) {
  model::Definition definition = pulled({24, 20, 28}, Kinematics::rotational);
  model::BoundaryDefinition edge;
  edge.name = "hinge";
  edge.selection.box = std::pair{Vec3{0, 0, 0}, Vec3{24 * d, 0, 0}};
  edge.fix = {true, true, true, false, false, false};
  definition.boundaries = {edge};
  driver::Simulation straight(definition, Communicator::world());
  statics::SolveReport report = *straight.run({}).solution;
  EXPECT_THAT(report.free_motions, testing::EndsWith(" is free to rotate about x"));
  EXPECT_LE(report.iterations, 20);
  EXPECT_GE(report.levels, 2);

  definition.boundaries.clear();
  for (const double end : {0.0, 20.0}) {
    model::BoundaryDefinition point;
    point.name = "point " + std::to_string(definition.boundaries.size());
    point.selection.point = Vec3{end * d, end * d, 0};
    point.fix = {true, true, true, false, false, false};
    definition.boundaries.push_back(point);
  }
  driver::Simulation askew(definition, Communicator::world());
  report = *askew.run({}).solution;
  EXPECT_THAT(report.free_motions, testing::EndsWith(" is free to rotate about (0.707, 0.707, 0)"));
  EXPECT_LE(report.iterations, 40);
}

}  // namespace
}  // namespace koshi
