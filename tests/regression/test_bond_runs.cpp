// The program on bodies whose bonds break: the same bits on any ranks and over a restart, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "io/history_reader.h"
#include "support/cracking_plate.h"

namespace koshi {
namespace {

using test::Ended;
using testing::HasSubstr;
namespace fs = std::filesystem;

// A plate with a stone that is pulled until a crack runs from its notch, and pressed together again.
const std::string plate =
    test::notched_plate("rock",
                        R"(law = "bonds", fracture_energy = "20 J/m^2", strength_scatter = { modulus = 10, seed = 3 })",
                        "calibration = \"isotropic\"\n") +
    test::pulled_with_a_stone(R"(x = "40 um", y = "5 um")") + R"(time_step = "0.32 us"
[output]
fields = ["displacement", "stress", "damage"]
crack_surface = true
history_every = "8 us"
checkpoint_every = "80 us"
)";

class BondRuns : public test::ProgramTest {
 protected:
  BondRuns() { test::write_file(directory_ / "plate.toml", plate); }
  std::string file(const fs::path& name) const { return test::read_file(directory_ / name); }
  double taken(const fs::path& output) const {
    return io::read_history(directory_ / output / "history.csv").back().values.back();
  }
};

TEST_F(BondRuns, SameBitsOnAnyRanksAndOverARestart) {
  const std::string shears = " --set material.rock.fracture.critical_shear=6e-4 --set body.periodic='[\"z\"]'";
  const std::string slit = " --set 'crack=[{center=[0.0325, 0.0175, 0], normal=[1, 0, 0], radius=0.004}]'";
  for (const std::string& variant : {std::string(), shears, slit}) {
    const std::string run = "run plate.toml --quiet" + variant;
    for (const char* ranks : {"1", "2", "3", "4"})
      ASSERT_EQ(koshi(run + " --out " + ranks + " --ranks " + ranks).code, 0) << ranks << variant;
    for (const fs::path ranks : {"2", "3", "4"})
      for (const char* name : {"history.csv", "checkpoint.h5", "events.csv", "cracks.vtp"})
        EXPECT_TRUE(file(ranks / name) == file(fs::path("1") / name)) << ranks << name << variant;

    ASSERT_EQ(koshi(run + " --out half --set 'analysis.duration=\"80 us\"'").code, 0);
    EXPECT_GT(taken("half"), 0) << "bonds have broken before the restart";
    EXPECT_GT(taken("1"), taken("half")) << "and after it";
    for (const std::string ranks : {"1", "3"}) {
      const Ended ended = koshi(run + " --restart half/checkpoint.h5 --out on" + ranks + " --ranks " + ranks);
      ASSERT_EQ(ended.code, 0) << ended.error;
      EXPECT_TRUE(file("on" + ranks + "/checkpoint.h5") == file("1/checkpoint.h5")) << ranks << variant;
    }
    for (const char* done : {"1", "2", "3", "4", "half", "on1", "on3"}) fs::remove_all(directory_ / done);
  }
}

// Cells whose bonds hold their corners together no longer are events and polygons; broken bonds go over into a case
// that starts from them, but into none with cells that crack.
TEST_F(BondRuns, TellsWhatBroke) {
  ASSERT_EQ(koshi("run plate.toml --quiet --out one").code, 0);
  const auto cracks = nlohmann::json::parse(file("one/summary.json")).at("cracks");
  EXPECT_GT(cracks.at("cells").get<int>(), 5);
  double cells = 0;
  const auto catalogue = io::read_history(directory_ / "one/events.csv");
  EXPECT_EQ(catalogue[6].name, "cells");
  for (const double number : catalogue[6].values) cells += number;
  EXPECT_EQ(cells, cracks.at("cells").get<int>());
  // Stresses are those of the bonds that are left, not what whole ones would carry across open cracks.
  const std::string next = "run plate.toml --quiet --set analysis.start_from=one --set 'analysis.duration=\"2 us\"' ";
  const Ended ended = koshi(next + "--out next");
  ASSERT_EQ(ended.code, 0) << ended.error;
  EXPECT_GE(taken("next"), taken("one"));
  const Ended other =
      koshi(next + "--out other --set material.rock.fracture='{tensile_strength=3e6, fracture_energy=20}'");
  EXPECT_EQ(other.code, 2);
  EXPECT_THAT(other.error,
              HasSubstr("holds a body whose bonds break; the fracture of this case must have the same law"));
}

TEST_F(BondRuns, ChecksTellTheStretch) {
  const Ended ended = koshi("check plate.toml --set lattice.spacing='\"2.5 mm\"'");
  EXPECT_EQ(ended.code, 0) << ended.error;
  // mu = 12.5 GPa and kn = 16/15 mu d: e_c = sqrt(40/(8.6667 33.33e6)) = 3.721e-4; E e_c = 11.16 MPa.
  EXPECT_THAT(ended.output, HasSubstr("bonds         of \"rock\" break at a stretch of 0.0003721"));
  EXPECT_THAT(ended.output, HasSubstr("1.12e+07 Pa"));
  EXPECT_EQ(ended.output.find("too coarse"), std::string::npos);
}

TEST_F(BondRuns, WhatBondsCannotCarryIsRefused) {
  const std::string fracture = "--set material.rock.fracture";
  const std::vector<std::pair<std::string, std::string>> wrong{
      {"--set lattice.calibration=bending-exact",
       "plate.toml:11:20: error: a cell of these springs has a volumetric spring"},
      {"--set material.rock.poissons_ratio=0.3", "a Poisson's ratio of at most 0.2; or take law = \"cohesive\""},
      {"--set lattice.cell=cube-I", "which belongs to no bond"},
      {"--set lattice.springs=plain --set lattice.calibration=paper", "plain springs belong to none"},
      {"--set analysis='{type=\"modes\"}' --set output='{}'", "type = \"modes\" follows no cracks"},
      {"--set material.stone.fracture='{tensile_strength=3e6, fracture_energy=20}'",
       "bonds of material \"rock\" break and cells of \"stone\" crack; materials that crack must have one law"},
      {"--set lattice.kinematics=least-squares", "with kinematics \"least-squares\" the bonds of a cell turn"},
      {fracture + ".critical_stretch=0", "critical_stretch is 0; it must lie between 1e-12 and 1"},
      {fracture + ".critical_shear=-1", "critical_shear is -1; it must lie between 1e-12 and 1"},
      {fracture + "='{law=\"bonds\"}'", "fracture has no \"fracture_energy\"; expected"},
      {fracture + "='{law=\"bonds\", fracture_energy=20, critical_stretch=1e-3}'",
       "\"fracture_energy\" has no meaning here; it goes with no critical_stretch, or law \"none\""},
      {fracture + "='{law=\"bonds\", fracture_energy=20, tensile_strength=3e6}'",
       "\"tensile_strength\" has no meaning here; it goes with law \"cohesive\" or \"none\""},
      {fracture + "='{tensile_strength=3e6, fracture_energy=20, critical_shear=1e-3}'",
       "\"critical_shear\" has no meaning here; it goes with law \"bonds\" or \"none\""},
  };
  for (const auto& [options, message] : wrong) {
    const Ended ended = koshi("check plate.toml " + options);
    EXPECT_EQ(ended.code, 2) << options << ended.output;
    EXPECT_THAT(ended.error, HasSubstr(message)) << options;
  }
  // Where cracks lie is known once there are cells, to a check too.
  for (const auto& [crack, message] :
       {std::pair{"{center=[0.04, 0.03, 0], normal=[1, 0, 0], radius=0.02}", "crack cuts bonds of material \"stone\""},
        {"{name=\"slit\", center=[0.5, 0.03, 0], normal=[1, 0, 0], radius=0.01}", "crack \"slit\" cuts no bond"}}) {
    for (const std::string command : {"check", "run"}) {
      const Ended ended = koshi(command + " plate.toml --set 'crack=[" + std::string(crack) + "]'");
      EXPECT_EQ(ended.code, 2) << command << crack;
      EXPECT_THAT(ended.error, HasSubstr(message)) << command << crack;
    }
  }
}

}  // namespace
}  // namespace koshi
