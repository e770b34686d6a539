// `koshi calibrate` from its command line to its output.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "../../apps/koshi/commands.h"
#include "koshi/error.h"

namespace koshi::app {
namespace {

using testing::HasSubstr;

struct Outcome {
  std::string output;
  std::string error;  ///< empty: none
};

Outcome calibrate(std::vector<std::string> arguments) {
  CLI::App program;
  add_calibrate_command(program);
  program.require_subcommand(1);
  arguments.insert(arguments.begin(), "calibrate");
  std::reverse(arguments.begin(), arguments.end());  // CLI11 takes a vector from its back
  Outcome outcome;
  testing::internal::CaptureStdout();
  try {
    program.parse(arguments);
  } catch (const std::exception& error) {
    outcome.error = error.what();
  }
  outcome.output = testing::internal::GetCapturedStdout();
  return outcome;
}

const std::vector<std::string> rock{"--youngs-modulus", "1112 MPa", "--poissons-ratio", "0.18", "--spacing", "0.2 cm"};

std::vector<std::string> rock_and(const std::vector<std::string>& more) {
  std::vector<std::string> all = rock;
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

// All six springs of the paper's Table 1 and the cantilever's (theory, section 5) [N/m], to their last digit.
TEST(CalibrateCommand, SpringsOfThePaper) {
  const std::vector<std::string> uniaxial{"--springs", "plain", "--size", "0.8 cm", "8 mm", "0.016"};
  const std::vector<std::string> cantilever{"--springs", "plain",  "--size", "1.8 cm",
                                            "7.8 cm",    "1.8 cm", "--axes", "yxz"};
  const auto check = [](const std::vector<std::string>& body, const std::string& cell, double kn, double kt,
                        double digit) {
    std::vector<std::string> arguments = body;
    arguments.insert(arguments.end(), {"--cell", cell, "--json"});
    const Outcome outcome = calibrate(rock_and(arguments));
    ASSERT_EQ(outcome.error, "");
    const auto edge = nlohmann::json::parse(outcome.output).at("springs").at("edge");
    EXPECT_NEAR(edge.at("kn").get<double>(), kn, digit / 2) << cell;
    EXPECT_NEAR(edge.at("kt").get<double>(), kt, digit / 2) << cell;
  };
  check(uniaxial, "cube-I", 1.340e6, 1.340e6, 1000);
  check(uniaxial, "cube-II", 0.605e6, 0.134e6, 1000);
  check(uniaxial, "cube-III", 0.345e6, 0.129e6, 1000);
  check(cantilever, "cube-I", 1.5266e6, 1.5266e6, 100);
  check(cantilever, "cube-II", 0.6258e6, 0.1487e6, 100);
  check(cantilever, "cube-III", 0.3590e6, 0.1422e6, 100);
}

TEST(CalibrateCommand, ReportAndDispersionFile) {
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "koshi_test_dispersion.csv";
  const Outcome outcome = calibrate(rock_and({"--dispersion", file.string(), "--density", "2.5 g/cm^3"}));
  EXPECT_EQ(outcome.error, "");
  EXPECT_THAT(outcome.output, HasSubstr("cube-III lattice, shared springs, calibration bending-exact"));
  EXPECT_THAT(outcome.output, HasSubstr("density           2500 kg/m^3"));
  std::ifstream csv(file);
  std::string line;
  int lines = 0;
  while (std::getline(csv, line)) ++lines;
  EXPECT_EQ(lines, 19);
  std::filesystem::remove(file);
}

TEST(CalibrateCommand, SaysWhatIsWrong) {
  EXPECT_THAT(calibrate({}).error, HasSubstr("--youngs-modulus is required"));
  EXPECT_THAT(calibrate(rock_and({"--cell", "cube-4"})).error, HasSubstr("--cell: error: \"cube-4\" is not known"));
  EXPECT_THAT(calibrate(rock_and({"--kinematics", "rotation"})).error, HasSubstr("did you mean \"rotational\"?"));
  EXPECT_THAT(calibrate(rock_and({"--density", "3 m"})).error, HasSubstr("--density: error: "));
  EXPECT_THAT(calibrate(rock_and({"--size", "1 cm", "1 cm"})).error, HasSubstr("--size"));
  EXPECT_THAT(calibrate(rock_and({"--size", "1 cm", "1 cm", "0.3 cm"})).error, HasSubstr("multiple of the spacing"));
  EXPECT_THAT(calibrate(rock_and({"--equations", "C1122", "C1212"})).error, HasSubstr("for calibration \"paper\""));
  EXPECT_THAT(calibrate(rock_and({"--calibration", "paper", "--equations", "C1122", "C2211"})).error,
              HasSubstr("do not determine kn and kt"));
  EXPECT_THAT(calibrate(rock_and({"--dispersion", "/no/such/folder/x.csv"})).error, HasSubstr("cannot write"));
  EXPECT_EQ(calibrate(rock).error, "");
}

// Refused springs are reported in full, then the error gives the exit code.
TEST(CalibrateCommand, RefusesUnstableSprings) {
  const Outcome outcome = calibrate(
      {"--youngs-modulus", "1 GPa", "--poissons-ratio", "-0.3", "--spacing", "1 mm", "--kinematics", "least-squares"});
  EXPECT_THAT(outcome.output, HasSubstr("verdict                        refused\n    unstable"));
  EXPECT_THAT(outcome.error, HasSubstr("unstable: a single cell has a negative eigenvalue"));
}

const std::vector<std::string> concrete{"--youngs-modulus",
                                        "30 GPa",
                                        "--poissons-ratio",
                                        "0.2",
                                        "--strength",
                                        "--fracture-energy",
                                        "100 J/m^2",
                                        "--tensile-strength",
                                        "3 MPa",
                                        "--cohesion",
                                        "8 MPa",
                                        "--friction-angle",
                                        "40 deg"};

std::vector<std::string> concrete_and(const std::vector<std::string>& more) {
  std::vector<std::string> all = concrete;
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

// What is asked for comes out along every direction, for both kinematics and ways of softening: f_t, G_f, and f_c = 2 c
// cos phi/(1 - sin phi) = 34.3121 MPa. E G_f/f_t^2 = 1/3 m; spacings below 2/sqrt 3 times that have all of it.
TEST(CalibrateCommand, StrengthAlongThreeDirections) {
  for (const char* kinematics : {"rotational", "least-squares"})
    for (const char* softening : {"linear", "exponential"}) {
      const Outcome outcome = calibrate(
          concrete_and({"--spacing", "5 mm", "--json", "--kinematics", kinematics, "--softening", softening}));
      ASSERT_EQ(outcome.error, "");
      const auto strength = nlohmann::json::parse(outcome.output).at("strength");
      ASSERT_EQ(strength.at("tests").size(), 3u);
      for (const auto& test : strength.at("tests")) {
        EXPECT_NEAR(test.at("tensile_strength").get<double>() / 3e6, 1, 1e-9) << test;
        EXPECT_NEAR(test.at("fracture_energy").get<double>() / 100, 1, 1e-6) << test;
        EXPECT_NEAR(test.at("compressive_strength").get<double>() / 34.3121e6, 1, 1e-5) << test;
      }
      EXPECT_NEAR(strength.at("characteristic_length").get<double>(), 1 / 3.0, 1e-12);
      EXPECT_NEAR(strength.at("spacing_limit").get<double>(), 2 / (3 * std::sqrt(3.0)), 1e-12);
    }
}

// In cells of 1 m cracks open at sqrt(2 E G_f/h): 2.449 MPa along an axis, over 3^(1/4) across a body diagonal; they
// keep the energy, to the size of the steps by which the block is pulled.
TEST(CalibrateCommand, StrengthOfCoarseCells) {
  const Outcome outcome = calibrate(concrete_and({"--spacing", "1 m", "--json"}));
  ASSERT_EQ(outcome.error, "");
  const auto tests = nlohmann::json::parse(outcome.output).at("strength").at("tests");
  EXPECT_NEAR(tests[0].at("tensile_strength").get<double>(), 2.44949e6, 1e1);
  EXPECT_NEAR(tests[2].at("tensile_strength").get<double>(), 2.44949e6 / std::pow(3, 0.25), 1e1);
  for (const auto& test : tests) EXPECT_NEAR(test.at("fracture_energy").get<double>(), 100, 1) << test;
  const Outcome text = calibrate(concrete_and({"--spacing", "1 m"}));
  EXPECT_THAT(text.output, HasSubstr("the spacing of 1 m is too coarse: cracks keep their energy and open early; below "
                                     "0.3849 m every direction has both"));
  EXPECT_THAT(calibrate(concrete_and({"--spacing", "5 mm"})).output,
              HasSubstr("the spacing of 0.005 m is fine enough"));
}

TEST(CalibrateCommand, StrengthsThatAreWrong) {
  EXPECT_THAT(calibrate(rock_and({"--strength"})).error, HasSubstr("--strength: error: needs --tensile-strength"));
  EXPECT_THAT(calibrate(rock_and({"--cohesion", "1 MPa"})).error, HasSubstr("--cohesion: error: belongs to the tests"));
  EXPECT_THAT(calibrate(concrete_and({"--spacing", "5 mm", "--springs", "plain"})).error,
              HasSubstr("fracture takes springs from cells, but plain springs belong to none"));
  const auto wrong = [&](const std::string& option, const std::string& value) {
    return calibrate(rock_and({"--strength", "--tensile-strength", "1 MPa", "--fracture-energy", "1 J/m^2",
                               "--cohesion", "9 MPa", option, value}))
        .error;
  };
  EXPECT_THAT(wrong("--friction-angle", "90 deg"), HasSubstr("an angle below 90 degrees such as"));
  EXPECT_THAT(wrong("--softening", "slow"), HasSubstr("\"slow\" is not known"));
}

}  // namespace
}  // namespace koshi::app
