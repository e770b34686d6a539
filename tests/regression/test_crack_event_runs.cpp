// The program on bodies that crack in equilibrium, event by event: ranks, closed cracks, what ends a run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "io/field_reader.h"
#include "io/history_reader.h"
#include "support/cracking_plate.h"

namespace koshi {
namespace {

using test::Ended;
using testing::HasSubstr;

using CrackEventRuns = test::CrackingPlate;

// In equilibrium ranks agree as far as the solver's tolerance lets them: the same cells crack, by the same factors. The
// plate is pulled evenly, which leaves nothing closed.
TEST_F(CrackEventRuns, AreTheSameOnTwoRanks) {
  const std::string events =
      "run plate.toml --quiet --set analysis='{type=\"static\", events=60}' --set "
      "output='{fields=[\"damage\"], every_events=25}' --set boundary.pull.history='[[\"0 s\", 1]]' --out ";
  ASSERT_EQ(koshi(events + "one").code, 0);
  ASSERT_EQ(koshi(events + "two --ranks 2").code, 0);
  const auto one = io::read_history(directory_ / "one/history.csv"),
             two = io::read_history(directory_ / "two/history.csv");
  ASSERT_EQ(one.size(), two.size());
  EXPECT_EQ(one[0].name, "event");
  EXPECT_EQ(one[1].name, "load factor");
  ASSERT_EQ(one[1].values.size(), 61u);
  ASSERT_EQ(two[1].values.size(), 61u);
  for (std::size_t row = 0; row < 61; ++row)
    EXPECT_NEAR(two[1].values[row] / std::max(one[1].values[row], 1e-3), one[1].values[row] == 0 ? 0 : 1, 1e-5) << row;
  EXPECT_EQ(io::list_samples(directory_ / "one").size(), 3u);
  const auto analysis = summary("one").at("analysis");
  EXPECT_EQ(analysis.at("reason"), "number of events");
  EXPECT_EQ(analysis.at("events"), 60);
  EXPECT_GT(analysis.at("cracked_cells"), 5);
  EXPECT_EQ(analysis.at("cracked_cells"), summary("two").at("analysis").at("cracked_cells"));
  EXPECT_GT(analysis.at("peak").at("event"), 0);
}

// A flaw right across the plate's upper part is closed by the pressure on the ends; ranks share its cells, and agree.
// It carries the pressure, by nodes that the border between the ranks, across x, does not touch.
TEST_F(CrackEventRuns, ClosedCracksAreTheSameOnTwoRanks) {
  const std::string pressed =
      "run plate.toml --quiet --set analysis='{type=\"static\", events=8}' --set output='{}' --set "
      "boundary.pull.displacement='{x=\"-20 um\"}' --set boundary.pull.history='[[\"0 s\", 1]]' --set "
      "'crack=[{center=[\"15 mm\", \"30 mm\", \"5 mm\"], normal=[1, 0.3, 0], radius=\"12 mm\"}]' --set "
      "'probe=[{name=\"push\", face=\"x-max\", quantity=\"reaction\"}]' ";
  ASSERT_EQ(koshi(pressed + "--out one").code, 0);
  ASSERT_EQ(koshi(pressed + "--out two --ranks 2").code, 0);
  ASSERT_EQ(koshi(pressed + "--set material.concrete.fracture.law=none --set crack=[] --out whole").code, 0);
  const auto one = io::read_history(directory_ / "one/history.csv"),
             two = io::read_history(directory_ / "two/history.csv"),
             whole = io::read_history(directory_ / "whole/history.csv");
  ASSERT_EQ(one[2].name, "push.reaction.x");
  ASSERT_EQ(one[2].values.size(), two[2].values.size());
  ASSERT_GE(one[2].values.size(), 2u);
  for (std::size_t row = 1; row < one[2].values.size(); ++row) {
    EXPECT_NEAR(two[1].values[row] / one[1].values[row], 1, 1e-5) << row;
    EXPECT_NEAR(two[2].values[row] / one[2].values[row], 1, 1e-5) << row;
  }
  // Over the stiffness of the plate without a flaw; pulled open the same flaw leaves 0.66 of it.
  EXPECT_NEAR(one[2].values[1] / one[1].values[1] / whole[1].values.back(), 0.864, 0.005);
}

// An equilibrium ends at the event at which its reaction has fallen or a crack has come to a face, and its catalogue
// holds every cell that cracked through, by number of event and load factor; the same on two ranks.
TEST_F(CrackEventRuns, EquilibriaEndWhenToldToAndTellWhatBroke) {
  const std::string events =
      "run plate.toml --set boundary.pull.history='[[\"0 s\", 1]]' --set output='{fields=[\"damage\"], "
      "crack_surface=true}' --set 'probe=[{name=\"pull\", face=\"x-max\", quantity=\"reaction\"}]' ";
  const std::string fallen = "--set analysis='{type=\"static\", stop_when={probe=\"pull\", below=0.4}}' ";
  const Ended one = koshi(events + fallen + "--out one");
  ASSERT_EQ(one.code, 0) << one.error;
  EXPECT_THAT(one.output, HasSubstr("of its largest, "));
  ASSERT_EQ(koshi(events + fallen + "--quiet --out two --ranks 2").code, 0);

  const auto history = io::read_history(directory_ / "one/history.csv");
  double peak = 0;
  int fell = 0;
  for (std::size_t row = 0; row < history[0].values.size(); ++row) {
    const double force = std::hypot(history[2].values[row], history[3].values[row], history[4].values[row]);
    peak = std::max(peak, force);
    fell += force < 0.4 * peak;
  }
  EXPECT_EQ(fell, 1) << "only the last row";
  EXPECT_THAT(summary("one").at("analysis").at("stop_reason").get<std::string>(),
              HasSubstr("the reaction \"pull\" of"));

  const nlohmann::json cracks = summary("one").at("cracks");
  EXPECT_GT(cracks.at("cells").get<int>(), 5);
  EXPECT_EQ(cracks.at("cells"), summary("two").at("cracks").at("cells"));
  const auto catalogue = io::read_history(directory_ / "one/events.csv");
  ASSERT_EQ(catalogue.size(), 10u);
  EXPECT_EQ(catalogue[2].name, "load factor");
  EXPECT_EQ(catalogue[7].name, "cells");
  double cells = 0;
  for (std::size_t e = 0; e < catalogue[0].values.size(); ++e) {
    cells += catalogue[7].values[e];
    EXPECT_EQ(catalogue[2].values[e], history[1].values[static_cast<std::size_t>(catalogue[0].values[e])]);
    EXPECT_LE(catalogue[0].values[e], catalogue[1].values[e]);
  }
  EXPECT_EQ(cells, cracks.at("cells").get<double>());
  EXPECT_THAT(file("one/cracks.vtp"),
              HasSubstr("NumberOfPolys=\"" + std::to_string(cracks.at("cells").get<int>()) + "\""));

  const Ended face = koshi(events + "--set analysis='{type=\"static\", stop_when={face=\"y-max\"}}' --out face");
  ASSERT_EQ(face.code, 0) << face.error;
  EXPECT_THAT(face.output, HasSubstr("a crack has reached the face y-max"));
}

}  // namespace
}  // namespace koshi
