// The program on bodies whose bonds break in equilibrium: against motion, on ranks, what ends a run, and its files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "io/history_reader.h"
#include "support/cracking_plate.h"
#include "support/program_test.h"

namespace koshi {
namespace {

using test::Ended;
using testing::HasSubstr;
namespace fs = std::filesystem;

const std::string plate =
    test::notched_plate("rock", R"(law = "bonds", fracture_energy = "20 J/m^2")", "calibration = \"isotropic\"\n") +
    R"([[boundary]]
name = "pull"
face = "x-max"
displacement = { x = "20 um", y = "2.5 um" }
history = [["0 s", 0], ["2 ms", 1]]
[analysis]
type = "static"
tolerance = 1e-6
[[probe]]
name = "pull"
face = "x-max"
quantity = "reaction"
[output]
fields = ["displacement", "damage"]
crack_surface = true
)";

class BondEquilibria : public test::ProgramTest {
 protected:
  BondEquilibria() { test::write_file(directory_ / "plate.toml", plate); }
  std::string file(const fs::path& name) const { return test::read_file(directory_ / name); }
  std::vector<io::HistoryColumn> history(const fs::path& output) const {
    return io::read_history(directory_ / output / "history.csv");
  }
  static double largest(const io::HistoryColumn& column) { return *std::ranges::max_element(column.values); }
  void run(const std::string& options) const {
    const Ended ended = koshi("run plate.toml --quiet " + options);
    ASSERT_EQ(ended.code, 0) << options << ended.error;
  }
};

// A notched plate in tension carries as much event by event as when it is pulled slowly: measured 1797 N, and 1805 N
// in motion, which takes 2 ms for ten waves' times. Steps of a fortieth of the way end up to a fortieth short of it,
// and where bonds have broken on the way there a little lower. The load factor goes back while the force falls; no
// motion of the end follows that.
TEST_F(BondEquilibria, CarryWhatSlowMotionCarries) {
  run("--out events");
  run("--out steps --set analysis.steps=40");
  run("--out motion --set 'analysis={type=\"dynamic\", duration=\"2 ms\", damping={kind=\"local\", factor=0.3}}' --set "
      "'output={history_every=\"2 us\"}'");
  const auto events = history("events"), steps = history("steps"), motion = history("motion");
  EXPECT_EQ(events[0].name, "event");
  EXPECT_EQ(steps[0].name, "time");
  const double peak = largest(events[2]);
  EXPECT_NEAR(peak / 1797, 1, 0.005);
  EXPECT_NEAR(peak / largest(motion[1]), 1, 0.02);
  EXPECT_NEAR(largest(steps[1]) / peak, 0.965, 0.02);
  // Events that break, each above the one after it: the envelope goes back by more than a third.
  double back = 1;
  for (std::size_t row = 1; row < events[2].values.size(); ++row)
    if (events[2].values[row] < 0.5 * peak && events[2].values[row] > 0.1 * peak)
      back = std::min(back, events[1].values[row] / largest(events[1]));
  EXPECT_LT(back, 0.5);
  EXPECT_EQ(summary("events").at("analysis").at("reason"), "the body has parted");
  EXPECT_EQ(summary("events").at("analysis").at("parted_cells"), 12);
  // All tell the work and where it went.
  for (const auto* columns : {&events, &steps}) {
    const std::size_t count = columns->size(), rows = columns->back().values.size();
    EXPECT_GT(rows, 40u);
    for (std::size_t row = 0; row < rows; ++row) {
      const auto value = [&](std::size_t from_end) { return (*columns)[count - from_end].values[row]; };
      EXPECT_NEAR((value(7) + value(1)) / (*columns)[count - 3].values.back(),
                  value(3) / (*columns)[count - 3].values.back(), 1e-5);
    }
  }
}

// The same bonds break at the same load factors.
TEST_F(BondEquilibria, AreTheSameOnTwoRanks) {
  const std::string closing =
      " --set 'boundary.pull.history=[[0, 0], [0.001, 1], [0.002, -1]]' --set analysis.steps=50 "
      "--set material.rock.fracture.critical_shear=6e-4";
  for (const std::string& variant : {std::string(), closing}) {
    run("--out one" + variant);
    run("--out two --ranks 2" + variant);
    const auto one = history("one"), two = history("two");
    ASSERT_EQ(one.size(), two.size());
    ASSERT_EQ(one[1].values.size(), two[1].values.size());
    EXPECT_GT(one[1].values.size(), 50u);
    const std::size_t reaction = variant.empty() ? 2 : 1;
    const double peak = largest(one[reaction]);
    for (std::size_t row = 0; row < one[1].values.size(); ++row)
      EXPECT_NEAR(two[reaction].values[row] / peak, one[reaction].values[row] / peak, 1e-5) << row;
    // Pressed together in the end, the plate carries.
    if (!variant.empty()) EXPECT_LT(one[1].values.back(), -peak);
    EXPECT_EQ(summary("one").at("cracks").at("cells"), summary("two").at("cracks").at("cells"));
    EXPECT_GT(summary("one").at("cracks").at("cells").get<int>(), 10);
    fs::remove_all(directory_ / "one");
    fs::remove_all(directory_ / "two");
  }
}

// The catalogue, its polygons, and a run that ends where a force has fallen; another one starts from its broken bonds.
TEST_F(BondEquilibria, TellWhatBroke) {
  run("--out one --set 'analysis.stop_when={probe=\"pull\", below=0.4}'");
  const auto force = history("one")[2].values;
  const auto analysis = summary("one").at("analysis");
  EXPECT_THAT(analysis.at("stop_reason").get<std::string>(), HasSubstr("is below 0.4"));
  EXPECT_LT(force.back(), 0.4 * *std::ranges::max_element(force));
  const int parted = analysis.at("parted_cells").get<int>();
  EXPECT_GT(parted, 0);
  EXPECT_LT(parted, 12);
  double cells = 0;
  const auto catalogue = io::read_history(directory_ / "one/events.csv");
  ASSERT_EQ(catalogue[7].name, "cells");
  for (const double number : catalogue[7].values) cells += number;
  EXPECT_EQ(cells, parted);
  EXPECT_THAT(file("one/cracks.vtp"), HasSubstr("NumberOfPolys=\"" + std::to_string(parted) + "\""));

  run("--out next --set analysis.start_from=one --set analysis.events=1");
  const auto next = history("next"), one = history("one");
  // The first equilibrium of the cracked plate: it is as stiff as at the last event of the run before.
  EXPECT_NEAR(next[2].values.back() / next[1].values.back() / (force.back() / one[1].values.back()), 1, 1e-4);
  EXPECT_NEAR(next.back().values.back(), one.back().values.back(), 1e-9 * one.back().values.back());
}

}  // namespace
}  // namespace koshi
