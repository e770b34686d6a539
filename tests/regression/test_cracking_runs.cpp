// The program on bodies that crack: the same bits on any ranks and over a restart, and what is refused or warned of.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "io/field_reader.h"
#include "io/history_reader.h"
#include "support/cracking_plate.h"

namespace koshi {
namespace {

using test::Ended;
using testing::HasSubstr;
namespace fs = std::filesystem;

using CrackingRuns = test::CrackingPlate;

TEST_F(CrackingRuns, SameBitsOnAnyRanks) {
  for (const char* ranks : {"1", "2", "4"})
    ASSERT_EQ(koshi(std::string("run plate.toml --quiet --out ") + ranks + " --ranks " + ranks).code, 0) << ranks;
  EXPECT_GT(std::ranges::count(file("1/history.csv"), '\n'), 20);
  for (const fs::path ranks : {"2", "4"}) {
    EXPECT_TRUE(file(ranks / "history.csv") == file("1/history.csv")) << ranks;
    EXPECT_TRUE(file(ranks / "checkpoint.h5") == file("1/checkpoint.h5")) << ranks;
  }
  // It cracked, and not everywhere.
  const io::FieldReader reader(io::list_samples(directory_ / "1").back().path);
  ASSERT_EQ(reader.fields().size(), 2u);
  EXPECT_EQ(reader.fields()[1].name, "damage");
  std::vector<std::int64_t> cells(12 * 9 * 2);
  for (std::size_t n = 0; n < cells.size(); ++n) cells[n] = static_cast<std::int64_t>(n);
  const std::vector<float> damage = reader.gather(reader.fields()[1], cells);
  EXPECT_GT(std::ranges::count_if(damage, [](float omega) { return omega > 0.99; }), 5);
  EXPECT_GT(std::ranges::count(damage, 0.0F), 50);
  EXPECT_TRUE(std::ranges::all_of(damage, [](float omega) { return omega >= 0 && omega <= 1; }));
}

// Random strengths and stiffnesses, with a correlation length or without, belong to cells and not to ranks; what came
// out is told by check, the log and the summary.
TEST_F(CrackingRuns, ScatterIsTheSameOnAnyRanks) {
  const std::string scatter =
      " --set 'material.concrete.fracture.strength_scatter={modulus=8, correlation_length=\"12 mm\", seed=7}'"
      " --set 'material.concrete.stiffness_scatter={distribution=\"normal\", variation=0.1, seed=8}'";
  for (const std::string ranks : {"1", "2", "4"}) {
    const Ended ended = koshi("run plate.toml --out s" + ranks + " --ranks " + ranks + scatter);
    ASSERT_EQ(ended.code, 0) << ended.error;
    EXPECT_THAT(ended.output + ended.error, HasSubstr("scatter: strength of \"concrete\": "));
    EXPECT_TRUE(file("s" + ranks + "/checkpoint.h5") == file("s1/checkpoint.h5")) << ranks;
  }
  ASSERT_EQ(koshi("run plate.toml --quiet --out plain").code, 0);
  EXPECT_NE(last_row("plain"), last_row("s1"));
  const Ended check = koshi("check plate.toml" + scatter);
  const nlohmann::json report = nlohmann::json::parse(file("s4/summary.json")).at("scatter").at("concrete");
  const auto line = [&](const std::string& property) {
    const nlohmann::json& r = report.at(property);
    return fmt::format("scatter       {} of \"concrete\": {} cells, mean {:.4g}, variation {:.4g}, correlation of ",
                       property, r.at("cells").get<int>(), r.at("mean").get<double>(), r.at("variation").get<double>());
  };
  for (const char* property : {"strength", "stiffness"}) EXPECT_THAT(check.output, HasSubstr(line(property)));
  // Neighbours of 5 mm are correlated by exp(-(5/12)^2) = 0.84 in strength, and not in stiffness, but for chance.
  EXPECT_NEAR(report.at("strength").at("correlation").get<double>(), 0.84, 0.1);
  EXPECT_NEAR(report.at("stiffness").at("correlation").get<double>(), 0, 0.15);
  EXPECT_NEAR(report.at("stiffness").at("variation").get<double>(), 0.1, 0.02);
}

// The checkpoint of a shorter run has cracks that are open and goes on as if nothing had happened, on other ranks too.
TEST_F(CrackingRuns, RestartsGoOnWithTheSameBits) {
  ASSERT_EQ(koshi("run plate.toml --quiet --out whole").code, 0);
  ASSERT_EQ(koshi("run plate.toml --quiet --out half --set 'analysis.duration=\"80 us\"'").code, 0);
  EXPECT_GT(last_row("half").back(), 0) << "cracks before the restart";
  EXPECT_GT(last_row("whole").back(), last_row("half").back()) << "and after it";
  EXPECT_FALSE(file("half/checkpoint.h5") == file("whole/checkpoint.h5"));
  for (const char* ranks : {"1", "2"}) {
    const Ended ended = koshi(std::string("run plate.toml --quiet --restart half/checkpoint.h5 --out on") + ranks +
                              " --ranks " + ranks);
    ASSERT_EQ(ended.code, 0) << ended.error;
    EXPECT_TRUE(file(std::string("on") + ranks + "/checkpoint.h5") == file("whole/checkpoint.h5")) << ranks;
    EXPECT_EQ(last_row(std::string("on") + ranks), last_row("whole"));
  }
}

// What a run tells of its cracks: a catalogue, a surface, their opening; the same on any ranks and over a restart.
TEST_F(CrackingRuns, CatalogueAndSurface) {
  const std::string options =
      " --quiet --set output.crack_surface=true --set 'output.fields=[\"damage\", \"crack_opening\"]'";
  ASSERT_EQ(koshi("run plate.toml --out one" + options).code, 0);
  ASSERT_EQ(koshi("run plate.toml --out three --ranks 3" + options).code, 0);
  ASSERT_EQ(koshi("run plate.toml --out half --set 'analysis.duration=\"80 us\"'" + options).code, 0);
  ASSERT_EQ(koshi("run plate.toml --out half --restart half/checkpoint.h5" + options).code, 0);
  for (const fs::path name : {"events.csv", "cracks.vtp"})
    for (const fs::path other : {"three", "half"})
      EXPECT_TRUE(file(other / name) == file(fs::path("one") / name)) << other << name;
  const nlohmann::json cracks = nlohmann::json::parse(file("one/summary.json")).at("cracks");
  EXPECT_GT(cracks.at("cells").get<int>(), 5);

  // Every cell that cracked through is a polygon, and one of an event.
  const std::vector<io::HistoryColumn> events = io::read_history(directory_ / "one/events.csv");
  ASSERT_EQ(events.size(), 9u);
  EXPECT_EQ(events[0].name, "time");
  EXPECT_EQ(events[6].name, "cells");
  double cells = 0, energy = 0;
  for (std::size_t e = 0; e < events[6].values.size(); ++e) {
    cells += events[6].values[e];
    energy += events[5].values[e];
    EXPECT_GT(events[0].values[e], 0);
    EXPECT_LE(events[0].values[e] + events[1].values[e], 160e-6);
  }
  EXPECT_EQ(cells, cracks.at("cells").get<double>());
  EXPECT_EQ(events[6].values.size(), cracks.at("events").at("count").get<std::size_t>());
  EXPECT_THAT(file("one/cracks.vtp"),
              HasSubstr("NumberOfPolys=\"" + std::to_string(cracks.at("cells").get<int>()) + "\""));
  // The others have taken something too: the rest of cracks [J].
  EXPECT_GT(energy, 0.5 * last_row("one").back());
  EXPECT_LT(energy, last_row("one").back());

  const io::FieldReader reader(io::list_samples(directory_ / "one").back().path);
  ASSERT_EQ(reader.fields().size(), 2u);
  std::vector<std::int64_t> all(12 * 9 * 2);
  for (std::size_t n = 0; n < all.size(); ++n) all[n] = static_cast<std::int64_t>(n);
  const std::vector<float> opening = reader.gather(reader.fields()[1], all);
  const auto [least, greatest] = std::ranges::minmax(opening);
  EXPECT_EQ(least, 0);
  EXPECT_LT(greatest, 3e-5) << "m, about what the end was moved";
}

// A run ends at the first row at which its reaction has fallen, or a crack has come to a face; a restart with the same
// condition ends at the same row, for it knows the largest reaction.
TEST_F(CrackingRuns, EndsWhenToldTo) {
  const std::string pull =
      " --set 'probe=[{name=\"pull\", face=\"x-max\", quantity=\"reaction\"}]'"
      " --set 'analysis.stop_when={probe=\"pull\", below=0.5, after=\"20 us\"}'";
  const Ended whole = koshi("run plate.toml --out whole" + pull);
  ASSERT_EQ(whole.code, 0) << whole.error;
  EXPECT_THAT(whole.output, HasSubstr("of its largest, "));
  const std::vector<io::HistoryColumn> history = io::read_history(directory_ / "whole/history.csv");
  std::vector<double> force;
  for (std::size_t row = 0; row < history[0].values.size(); ++row)
    force.push_back(std::hypot(history[1].values[row], history[2].values[row], history[3].values[row]));
  const double peak = *std::ranges::max_element(force);
  EXPECT_LT(force.back(), 0.5 * peak);
  EXPECT_LT(history[0].values.back(), 150e-6);
  for (std::size_t row = 0; row + 1 < force.size(); ++row)
    EXPECT_TRUE(force[row] >=
                    0.5 * *std::max_element(force.begin(), force.begin() + static_cast<std::ptrdiff_t>(row) + 1) ||
                history[0].values[row] < 20e-6)
        << row;
  EXPECT_THAT(file("whole/summary.json"), HasSubstr("\"stop_reason\""));

  ASSERT_EQ(koshi("run plate.toml --quiet --out half --set 'analysis.duration=\"40 us\"'" + pull).code, 0);
  for (const char* ranks : {"1", "2"}) {
    ASSERT_EQ(koshi(std::string("run plate.toml --quiet --restart half/checkpoint.h5 --out on") + ranks + " --ranks " +
                    ranks + pull)
                  .code,
              0);
    EXPECT_EQ(last_row(std::string("on") + ranks), last_row("whole")) << ranks;
  }
  const Ended face = koshi("run plate.toml --out face --ranks 2 --set 'analysis.stop_when={face=\"y-max\"}'");
  ASSERT_EQ(face.code, 0) << face.error;
  EXPECT_THAT(face.output, HasSubstr("a crack has reached the face y-max"));
}

// A crack from the start is there on any ranks, in a checkpoint, and in a case that starts from another.
TEST_F(CrackingRuns, BeginsWithCracks) {
  const std::string flaw =
      " --set 'crack=[{center=[\"15 mm\", \"45 mm\", \"5 mm\"], normal=[1, 0.3, 0], radius=\"16 mm\"}]'";
  for (const std::string ranks : {"1", "2", "4"}) {
    ASSERT_EQ(koshi("run plate.toml --quiet --out c" + ranks + " --ranks " + ranks + flaw).code, 0);
    EXPECT_TRUE(file("c" + ranks + "/checkpoint.h5") == file("c1/checkpoint.h5")) << ranks;
  }
  const auto cracked = [&](const fs::path& output) {
    return nlohmann::json::parse(file(output / "summary.json")).at("cracks").at("cells").get<int>();
  };
  const std::string still = " --set 'analysis.duration=\"1 us\"'";
  ASSERT_EQ(koshi("run plate.toml --quiet --out start" + flaw + still).code, 0);
  EXPECT_EQ(cracked("start"), 6) << "three rows that are two cells deep";
  const std::string events = file("start/events.csv");
  EXPECT_EQ(std::ranges::count(events, '\n'), 1) << "none of them an event of the run";
  ASSERT_EQ(koshi("run plate.toml --quiet --out plain").code, 0);
  ASSERT_EQ(koshi("run plate.toml --quiet --out next --set analysis.start_from=plain" + flaw + still).code, 0);
  EXPECT_GT(cracked("next"), cracked("plain"));
  double fresh = 0;
  for (const double cells : io::read_history(directory_ / "next/events.csv")[6].values) fresh += cells;
  EXPECT_LT(fresh, cracked("next") - cracked("plain")) << "what had cracked is none either";
}

// Cracks go over into another case that starts from their checkpoint, but into none that cannot have them.
TEST_F(CrackingRuns, StartsFromCrackedBodies) {
  ASSERT_EQ(koshi("run plate.toml --quiet --out first").code, 0);
  const std::string next = "run plate.toml --quiet --set analysis.start_from=first --set 'analysis.duration=\"2 us\"' ";
  const Ended ended = koshi(next + "--out next");
  ASSERT_EQ(ended.code, 0) << ended.error;
  EXPECT_GE(last_row("next").back(), last_row("first").back());
  const Ended whole = koshi(next + "--out none --set material.concrete.fracture.law=none --set output.fields=[]");
  EXPECT_EQ(whole.code, 2);
  EXPECT_THAT(whole.error, HasSubstr("holds a body that can crack, and no material of this case can"));
}

TEST_F(CrackingRuns, WrongFractureIsRefusedInWords) {
  const std::string fracture = "--set material.concrete.fracture.";
  const std::vector<std::pair<std::string, std::string>> wrong{
      {fracture + "tensile_strength='\"-3 MPa\"'", "tensile_strength is -3000000 Pa; it must lie between 1e-09 Pa and"},
      {"--set material.concrete.fracture='{fracture_energy=100}'", "fracture has no \"tensile_strength\"; expected"},
      {fracture + "fracture_energy=0", "fracture_energy is 0 J/m^2; it must lie between 1e-15 J/m^2 and"},
      {fracture + "fracture_energy='\"3 MPa\"'",
       "\"3 MPa\" is a pressure; expected an energy per area such as \"100 J/m^2\""},
      {fracture + "friction_angle='\"90 deg\"'", "an angle below 90 degrees such as \"40 deg\""},
      {fracture + "residual_friction_angle='\"-1 deg\"'",
       "residual_friction_angle is -0.0174532925199 rad; it must be at least 0 rad"},
      {"--set material.concrete.fracture='{tensile_strength=3e6, fracture_energy=20, friction_angle=0.5}'",
       "\"friction_angle\" has no meaning here; it goes with a cohesion"},
      {fracture + "cohesion='\"3 MPa\"'", "the cohesion must be above 3.21676e+06 Pa"},
      {fracture + "law=brittle", "unknown law \"brittle\"; allowed: \"cohesive\", \"bonds\", \"none\""},
      {"--set lattice.springs=plain", "plain springs belong to none; use springs = \"shared\""},
      {"--set lattice.calibration=paper", "fracture needs springs that are isotropic"},
      {"--set analysis.events=5", "\"events\" has no meaning here; it goes with type \"static\""},
      {"--set output.every_events=5", "every_events counts the events of a static body that cracks"},
      {"--set analysis='{type=\"static\", events=0}' --set output='{}'", "events is 0; it must lie between 1 and"},
      {"--set analysis='{type=\"modes\"}' --set output='{}'", "type = \"modes\" follows no cracks"},
      {"--set 'crack=[{center=[1, 0, 0], normal=[1, 0, 0], radius=0.01}]'", "crack cuts no cell of the body"},
      {fracture + "law=none", "damage belongs to materials that crack, and there is none"},
  };
  for (const auto& [options, message] : wrong) EXPECT_THAT(refused(options), HasSubstr(message)) << options;
}

// Without cracks an equilibrium is as good as any, and 30 GPa 20 J/m^2 2/(3 MPa)^2 = 133 mm are far from the spacing;
// with a strength of 30 MPa they are 1.33 mm, over sqrt(3) 0.77 mm. Cells of 5 mm then break at 30 sqrt(1.33/5) = 15.5
// MPa across x, at 11.8 MPa obliquely.
TEST_F(CrackingRuns, ChecksWarnOfCoarseSpacings) {
  const Ended fine = koshi("check plate.toml");
  EXPECT_EQ(fine.code, 0) << fine.error;
  EXPECT_EQ((fine.output + fine.error).find("too coarse"), std::string::npos);
  const Ended coarse =
      koshi("check plate.toml --set material.concrete.fracture='{tensile_strength=3e7, fracture_energy=20}'");
  EXPECT_EQ(coarse.code, 0) << coarse.error;
  EXPECT_THAT(coarse.output + coarse.error, HasSubstr("too coarse for material \"concrete\""));
  EXPECT_THAT(coarse.output + coarse.error, HasSubstr("open at 1.55e+07 Pa, oblique ones at as little as 1.18e+07 Pa"));
  EXPECT_THAT(coarse.output + coarse.error, HasSubstr("a spacing below 0.00077 m keeps both"));
  const Ended whole = koshi(
      "check plate.toml --set material.concrete.fracture.law=none --set output.fields=[] --set "
      "analysis='{type=\"static\"}' --set output='{}'");
  EXPECT_EQ(whole.code, 0) << whole.error;
}

}  // namespace
}  // namespace koshi
