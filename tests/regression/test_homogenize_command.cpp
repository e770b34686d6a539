// `koshi homogenize` from the command line: files, exit codes, messages.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/program_test.h"

namespace koshi {
namespace {

using test::Ended;
using testing::HasSubstr;
using Json = nlohmann::json;

// Two layers across z: stiff below, soft above.
const std::string layers = R"([lattice]
spacing = "1 mm"
kinematics = "least-squares"
[body]
size = ["4 mm", "4 mm", "4 mm"]
material = "stiff"
periodic = ["x", "y", "z"]
[material.stiff]
youngs_modulus = "8 GPa"
poissons_ratio = 0
density = "2000 kg/m^3"
[material.soft]
youngs_modulus = "2 GPa"
poissons_ratio = 0
density = "1000 kg/m^3"
[[region]]
shape = "box"
min = ["0 mm", "0 mm", "2 mm"]
max = ["4 mm", "4 mm", "4 mm"]
material = "soft"
[analysis]
type = "static"
)";

class HomogenizeCommand : public test::ProgramTest {
 protected:
  Ended with(const std::string& arguments) {
    test::write_file(directory_ / "case.toml", layers);
    return koshi("homogenize case.toml " + arguments);
  }
};

TEST_F(HomogenizeCommand, WritesTheStiffnessAndShowsIt) {
  const Ended ended = with("--out out");
  EXPECT_EQ(ended.code, 0) << ended.error;
  for (const char* part : {"effective stiffness C [Pa]", "Voigt", "Reuss", "fraction of soft", "results in out"})
    EXPECT_THAT(ended.output, HasSubstr(part));
  const Json json = Json::parse(test::read_file(directory_ / "out/stiffness.json"));
  // nu = 0: along the layers the mean of 8 and 2 GPa, across them 2 / (1/8 + 1/2) = 3.2 GPa; shear with half of these.
  const double expected[6] = {5e9, 5e9, 3.2e9, 1.6e9, 1.6e9, 2.5e9};
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j) {
      EXPECT_NEAR(json["stiffness"][i][j].get<double>() / 1e9, i == j ? expected[i] / 1e9 : 0, 1e-6) << i << j;
      EXPECT_NEAR(json["compliance"][i][j].get<double>() * 1e9, i == j ? 1e9 / expected[i] : 0, 1e-6) << i << j;
    }
  EXPECT_NEAR(json["engineering"]["youngs_modulus"][2].get<double>() / 3.2e9, 1, 1e-6);
  EXPECT_EQ(json["density"], 1500);
  EXPECT_EQ(json["porosity"], 0);
  EXPECT_EQ(json["phases"]["soft"], 0.5);
  // P waves along z: sqrt(3.2e9 / 1500) m/s.
  EXPECT_NEAR(json["wave_speeds"]["z"][0].get<double>(), 1460.593, 1e-3);
  EXPECT_EQ(json["cases"].size(), 6u);
  const std::string table = test::read_file(directory_ / "out/stiffness.csv");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 7);
  EXPECT_TRUE(std::filesystem::exists(directory_ / "out/resolved.toml"));

  // Again into the same directory, on two ranks, without a word: the same numbers.
  const Ended again = with("--out out --ranks 2 --quiet");
  EXPECT_EQ(again.code, 0) << again.error;
  EXPECT_EQ(again.output, "");
  const Json repeated = Json::parse(test::read_file(directory_ / "out/stiffness.json"));
  EXPECT_EQ(repeated["stiffness"], json["stiffness"]);
}

TEST_F(HomogenizeCommand, RefusesWhatHasNoEffectiveStiffness) {
  const std::pair<const char*, const char*> wrong[] = {
      {"--set 'body.periodic=[\"x\",\"z\"]'", "not periodic in y"},
      {"--set 'lattice.springs=\"plain\"'", "plain springs"},
      {"--set 'load=[{name=\"g\",acceleration=[\"0 m/s^2\",\"0 m/s^2\",\"-9.81 m/s^2\"]}]'", "remove the loads"},
      {"--set 'boundary=[{name=\"b\",point=[\"0 mm\",\"0 mm\",\"0 mm\"],fix=[\"x\"]}]'", "remove the boundaries"},
  };
  for (const auto& [arguments, message] : wrong) {
    const Ended ended = with(std::string(arguments) + " --out wrong");
    EXPECT_EQ(ended.code, 2) << arguments;
    EXPECT_THAT(ended.error, HasSubstr(message));
    EXPECT_FALSE(std::filesystem::exists(directory_ / "wrong")) << arguments;
  }
}

}  // namespace
}  // namespace koshi
