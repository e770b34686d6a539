// The program on bodies that crack in steps of their loads: files, ranks, what ends a run, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "driver/run_simulation.h"
#include "io/field_reader.h"
#include "io/history_reader.h"
#include "koshi/input.h"
#include "support/cracking_plate.h"

namespace koshi {
namespace {

using test::Ended;
using testing::HasSubstr;
namespace fs = std::filesystem;

const std::string plate =
    test::notched_plate("concrete",
                        R"(tensile_strength = "3 MPa", fracture_energy = "100 J/m^2", softening = "linear")") +
    R"([[boundary]]
name = "pull"
face = "x-max"
fix = ["y", "z", "rx", "ry", "rz"]
displacement = { x = "0.1 mm" }
history = [["0 s", 0], ["1 s", 1]]
[analysis]
type = "static"
tolerance = 1e-7
steps = 40
[[probe]]
name = "pull"
face = "x-max"
quantity = "reaction"
[output]
fields = ["displacement", "damage"]
every = "0.25 s"
)";

class CrackStepRuns : public test::ProgramTest {
 protected:
  CrackStepRuns() { test::write_file(directory_ / "plate.toml", plate); }
  std::vector<io::HistoryColumn> history(const fs::path& output) const {
    return io::read_history(directory_ / output / "history.csv");
  }
  static double largest(const io::HistoryColumn& column) { return *std::ranges::max_element(column.values); }
};

// Ranks agree as far as the solver's tolerance lets them. The catalogue is one of time, and samples are taken by time.
TEST_F(CrackStepRuns, AreTheSameOnTwoRanks) {
  ASSERT_EQ(koshi("run plate.toml --quiet --out one").code, 0);
  ASSERT_EQ(koshi("run plate.toml --quiet --out two --ranks 2").code, 0);
  const auto one = history("one"), two = history("two");
  ASSERT_EQ(one.size(), two.size());
  EXPECT_EQ(one[0].name, "time");
  EXPECT_EQ(one[1].name, "pull.reaction.x");
  ASSERT_EQ(one[1].values.size(), 41u);
  ASSERT_EQ(two[1].values.size(), 41u);
  const double peak = largest(one[1]);
  for (std::size_t row = 0; row < 41; ++row) EXPECT_NEAR(two[1].values[row] / peak, one[1].values[row] / peak, 1e-3);
  EXPECT_EQ(io::list_samples(directory_ / "one").size(), 4u);
  EXPECT_DOUBLE_EQ(io::list_samples(directory_ / "one").front().time, 0.25);
  const auto analysis = summary("one").at("analysis");
  EXPECT_EQ(analysis.at("reason"), "the end of the histories");
  EXPECT_EQ(analysis.at("steps"), 40);
  EXPECT_GT(analysis.at("equilibria"), 40);
  EXPECT_EQ(analysis.at("time"), 1);
  EXPECT_FALSE(analysis.contains("events"));
  EXPECT_EQ(analysis.at("cracked_cells"), summary("two").at("analysis").at("cracked_cells"));
  const auto events = io::read_history(directory_ / "one/events.csv");
  EXPECT_EQ(events[0].name, "time");
  EXPECT_GE(events[0].values.size(), 1u);
}

// The same body event by event. Its force goes by teeth: where one is at its tip, the others are up to 15 % below
// theirs, and two cells go together of the 12 that carry, so that the strength comes out up to some per cent lower.
TEST_F(CrackStepRuns, AgreeWithEvents) {
  ASSERT_EQ(koshi("run plate.toml --quiet --out steps").code, 0);
  const Ended ended = koshi(
      "run plate.toml --quiet --out events --set 'analysis={type=\"static\", tolerance=1e-7, events=1000}' --set "
      "output='{}'");
  ASSERT_EQ(ended.code, 0) << ended.error;
  const auto steps = history("steps"), events = history("events");
  EXPECT_NEAR(largest(steps[1]) / largest(events[2]), 1.02, 0.02);
  // 100 J/m^2 on a ligament of 3 cm^2, and a little at the notch.
  EXPECT_NEAR(steps.back().values.back() / events.back().values.back(), 1, 0.02);
}

TEST_F(CrackStepRuns, EndWhenAsked) {
  ASSERT_EQ(koshi("run plate.toml --quiet --out half --set 'analysis.stop_when={probe=\"pull\", below=0.5, after=\"0.1 "
                  "s\"}'")
                .code,
            0);
  const auto force = history("half")[1].values;
  EXPECT_LT(force.size(), 41u);
  EXPECT_LT(force.back(), 0.5 * *std::ranges::max_element(force));
  EXPECT_GE(force[force.size() - 2], 0.5 * *std::ranges::max_element(force));
  EXPECT_THAT(summary("half").at("analysis").at("stop_reason").get<std::string>(), HasSubstr("is below 0.5"));
}

// A step that finds no end is an error, and the run ends where the step before has: with its rows, its fields and its
// state. Steps in which nothing cracks take one equilibrium, others some six: three are soon too few.
TEST_F(CrackStepRuns, KeepWhatCameBeforeAStepWithoutEnd) {
  const std::vector<std::string> slow{R"(boundary.pull.history=[["0 s", 0], ["1 s", 0.1]])"};
  ASSERT_EQ(koshi("run plate.toml --quiet --out whole --set '" + slow[0] + "'").code, 0);
  driver::Simulation simulation(io::read_case((directory_ / "plate.toml").string(), slow), Communicator::world());
  simulation.limit_equilibria(3);
  driver::RunOptions options;
  options.directory = directory_ / "cut";
  options.quiet = true;
  const driver::Outcome outcome = driver::run_simulation(simulation, options);
  const auto cut = history("cut"), whole = history("whole");
  const std::size_t rows = cut[0].values.size();
  ASSERT_GT(rows, 5u);
  ASSERT_LT(rows, 40u);
  ASSERT_EQ(cut.size(), whole.size());
  for (std::size_t column = 0; column < cut.size(); ++column)
    for (std::size_t row = 0; row < rows; ++row)
      EXPECT_EQ(cut[column].values[row], whole[column].values[row]) << cut[column].name << row;
  const auto elastic = std::ranges::find(cut, "elastic energy", &io::HistoryColumn::name);
  ASSERT_NE(elastic, cut.end());
  EXPECT_NEAR(simulation.measure().balance.elastic_energy / elastic->values.back(), 1, 1e-6);
  EXPECT_DOUBLE_EQ(io::list_samples(directory_ / "cut").back().time, cut[0].values.back());
  const auto analysis = summary("cut").at("analysis");
  EXPECT_EQ(analysis.at("reason"), "a step without an end");
  EXPECT_EQ(analysis.at("steps"), rows - 1);
  EXPECT_EQ(analysis.at("time"), cut[0].values.back());
  try {
    driver::require_rest(simulation.model(), outcome, "; the rest");
    ADD_FAILURE() << "not an error";
  } catch (const RunError& error) {
    EXPECT_THAT(error.what(), HasSubstr("step " + std::to_string(rows) + " of 40 (t = "));
    EXPECT_THAT(error.what(), HasSubstr("finds no end: after 3 equilibria a cell or a bond is still off its limit by"));
    EXPECT_THAT(error.what(), HasSubstr("take smaller steps (more analysis.steps), or follow cracks event by event"));
    EXPECT_THAT(error.what(), HasSubstr("; the rest"));
  }
}

TEST_F(CrackStepRuns, WrongStepsAreRefusedInWords) {
  const std::vector<std::pair<std::string, std::string>> wrong{
      {"--set analysis.steps=0", "steps is 0; it must lie between 1 and"},
      {"--set analysis.steps=2.5", "steps is"},
      {"--set analysis.events=5", "\"events\" has no meaning here; it goes with type \"static\" without steps"},
      {"--set analysis='{type=\"dynamic\", duration=1, steps=5}'", "\"steps\" has no meaning here; it goes with type"},
      {"--set boundary.pull.history='[[0, 1]]'", "there is none that takes time; give what grows a history, such as"},
      {"--set material.concrete.fracture.law=none --set output='{}'", "no material of this one can crack"},
      {"--set output.every_events=5", "samples of a run in time or in steps are taken by every"},
  };
  for (const auto& [options, message] : wrong) {
    const Ended ended = koshi("check plate.toml " + options);
    EXPECT_EQ(ended.code, 2) << options << ended.output;
    EXPECT_THAT(ended.error, HasSubstr(message)) << options;
  }
  EXPECT_EQ(wrong.size(), 7u);
}

}  // namespace
}  // namespace koshi
