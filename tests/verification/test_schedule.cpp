// Prescribed motion, end times and time steps of explicit runs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "driver/simulation.h"
#include "koshi/dynamics.h"
#include "koshi/run.h"
#include "support/cases.h"

namespace koshi {
namespace {

using model::Face;
using testing::HasSubstr;

// A stiff little block whose bottom is held and whose top is moved by `top`, in a damped run of 2 s.
model::Definition pushed(model::BoundaryDefinition top) {
  model::Definition definition = test::block({2, 2, 2}, 0.5, {3, 0.2, 1});
  top.name = "top";
  top.selection.face = Face::z_max;
  definition.boundaries = {test::fixed("bottom", Face::z_min, {0, 1, 2}), top};
  definition.analysis.duration = 2;
  definition.analysis.time_step = 0.0625;
  return definition;
}

// The z displacement of the top face at the end; all its nodes must have the same.
double end_of_top(const model::Definition& definition, int component = 2) {
  driver::Simulation simulation(definition, Communicator::world());
  const driver::Outcome outcome = simulation.run({});
  EXPECT_DOUBLE_EQ(simulation.state().time, 2);
  EXPECT_EQ(outcome.steps, 32);
  const lattice::Layout& layout = simulation.model().layout();
  const double* u = simulation.state().displacement.component(component);
  const double value = u[layout.index(1, 1, 2)];
  for (std::int64_t j = 0; j < 3; ++j)
    for (std::int64_t i = 0; i < 3; ++i) EXPECT_DOUBLE_EQ(u[layout.index(i, j, 2)], value);
  return value;
}

TEST(PrescribedMotion, ArrivesWhereItIsSent) {
  model::BoundaryDefinition top;
  top.velocity[2] = -0.01;
  EXPECT_NEAR(end_of_top(pushed(top)), -0.02, 1e-16);  // v t

  top.ramp = 0.5;
  EXPECT_NEAR(end_of_top(pushed(top)), -0.0175, 1e-16);  // v (t - ramp/2): the midpoint rule is exact

  top = {};
  top.displacement[2] = 0.03;
  EXPECT_NEAR(end_of_top(pushed(top)), 0.03, 1e-16);
  top.ramp = 8;
  EXPECT_NEAR(end_of_top(pushed(top)), 0.03 * 2 / 8, 1e-16);
  top.ramp = 0;
  top.history = {{0, 0}, {1, 2}, {3, 1}};  // at t = 2: halfway from 2 to 1
  EXPECT_NEAR(end_of_top(pushed(top)), 0.03 * 1.5, 1e-16);
  top.ramp = 4;  // and both together multiply
  EXPECT_NEAR(end_of_top(pushed(top)), 0.03 * 1.5 / 2, 1e-16);

  top = {};
  top.displacement[4] = 0.2;  // a rotation
  EXPECT_NEAR(end_of_top(pushed(top), 4), 0.2, 1e-16);
  top = {};
  top.velocity[5] = 0.1;
  top.history = {{0, 1}, {1, 1}, {2, 0}};  // 0.1 (1 + 1/2)
  EXPECT_NEAR(end_of_top(pushed(top), 5), 0.15, 1e-15);
}

// On the way too: a tabulated displacement is met at the end of every step.
TEST(PrescribedMotion, FollowsItsTableAtEveryStep) {
  model::BoundaryDefinition top;
  top.displacement[0] = 0.01;
  top.history = {{0.25, 1}, {0.5, -1}, {1.25, 3}};
  const model::Definition definition = pushed(top);
  const model::Model model = model::make_model(definition, Communicator::world());
  model::State state(model);
  dynamics::ExplicitSolver solver(model, state, 0.0625);
  const std::int64_t node = model.layout().index(2, 0, 2);
  EXPECT_NEAR(state.displacement.component(0)[node], 0.01, 1e-17);  // constant before its first entry
  for (int step = 1; step <= 32; ++step) {
    solver.step();
    const double t = 0.0625 * step;
    const double factor = t <= 0.25 ? 1 : t <= 0.5 ? 1 - 8 * (t - 0.25) : t <= 1.25 ? -1 + (t - 0.5) * 4 / 0.75 : 3;
    EXPECT_NEAR(state.displacement.component(0)[node], 0.01 * factor, 1e-15) << t;
  }
}

// The step is shortened a little so that a whole number of steps fills the duration.
TEST(Schedule, RunsEndExactlyOnTheirDuration) {
  for (const double duration : {1.0, 0.7, 1.0 / 3, 0.0123456789}) {
    model::Definition definition = test::block({1, 1, 1}, 0.5, {3, 0.2, 1});
    definition.analysis.duration = duration;
    definition.analysis.time_step = 0.01;
    driver::Simulation simulation(definition, Communicator::world());
    const driver::Outcome outcome = simulation.run({});
    EXPECT_DOUBLE_EQ(simulation.state().time, duration);
    EXPECT_EQ(outcome.steps, static_cast<std::int64_t>(std::ceil(duration / 0.01 - 1e-9)));
    EXPECT_LE(outcome.time_step, 0.01 * (1 + 1e-12));
  }
}

std::string message_of(const model::Definition& definition, bool& input_error) {
  try {
    driver::Simulation(definition, Communicator::world()).run({});
  } catch (const InputError& error) {
    input_error = true;
    return error.what();
  } catch (const RunError& error) {
    input_error = false;
    return error.what();
  }
  return "";
}

// A small kick lets the highest mode grow once the step exceeds its limit.
model::Definition kicked(double time_step) {
  model::Definition definition = test::block({3, 3, 3}, 0.002);
  definition.boundaries = {test::fixed("bottom", Face::z_min, {0, 1, 2, 3, 4, 5})};
  model::LoadDefinition load;
  load.selection.face = Face::z_max;
  load.force = Vec3{1, 2, 3};
  definition.loads = {load};
  definition.analysis.time_step = time_step;
  definition.analysis.duration = 2000 * time_step;
  return definition;
}

TEST(TimeStep, AboveTheLimitIsRefused) {
  driver::Simulation probe(kicked(1e-9), Communicator::world());
  const driver::Outcome outcome = probe.run({});
  ASSERT_TRUE(outcome.stable);
  const double limit = outcome.stable->limit();
  bool input_error = false;
  EXPECT_EQ(message_of(kicked(0.99 * limit), input_error), "");
  const std::string message = message_of(kicked(1.01 * limit), input_error);
  EXPECT_TRUE(input_error);
  EXPECT_THAT(message, HasSubstr("is above the stable limit"));
  EXPECT_THAT(message, HasSubstr("allow_unstable_step = true"));
}

// A count of steps that no run can make is refused at the key that makes it, before a step is taken: it is never cut to
// one that fits.
TEST(TimeStep, CountOfStepsIsBounded) {
  const auto refused = [](const model::Definition& definition, const std::string& words) {
    bool input_error = false;
    const std::string message = message_of(definition, input_error);
    EXPECT_TRUE(input_error) << message;
    EXPECT_THAT(message, HasSubstr(words));
    EXPECT_THAT(message, HasSubstr("at most 1e+12 can be made"));
  };
  model::Definition definition = kicked(1e-9);
  definition.analysis.time_step = 1e-15;
  definition.analysis.duration = 1.0;
  refused(definition, "takes 1e+15 steps of 1e-15 s");
  refused(definition, "use a larger time_step, or a shorter duration");
  definition.analysis.time_step.reset();
  definition.analysis.safety = 1e-6;  // of a limit of about 2.6e-6 s
  definition.analysis.duration = 10.0;
  refused(definition, "use a larger safety, or a shorter duration");
  definition.analysis.safety = 0.9;
  definition.analysis.duration = 1e13;
  refused(definition, "use a shorter duration, or check the units");
  definition.analysis.type = model::AnalysisDefinition::Type::quasi_static;
  refused(definition, "a quasi-static run may do without a duration");
  // The same from `koshi check`, which makes no step.
  EXPECT_THROW(driver::check(definition, Communicator::world()), InputError);
  definition.analysis.duration.reset();
  EXPECT_NO_THROW(driver::check(definition, Communicator::world()));
}

TEST(TimeStep, TooLargeByWishDivergesAndSaysWhere) {
  model::Definition definition = kicked(3e-6);  // above d / c_p = 2.6e-6 s and 2 / omega_max
  definition.analysis.allow_unstable_step = true;
  bool input_error = true;
  const std::string message = message_of(definition, input_error);
  EXPECT_FALSE(input_error);
  EXPECT_THAT(message, testing::ContainsRegex("diverged at or before step [0-9]+ .*node \\([0-9], [0-9], [0-9]\\)"));
  EXPECT_THAT(message, HasSubstr("use a smaller time_step than"));
}

}  // namespace
}  // namespace koshi
