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
  EXPECT_NEAR(json["density"].get<double>(), 1500, 1e-9);
  EXPECT_EQ(json["porosity"], 0);
  EXPECT_EQ(json["phases"]["soft"], 0.5);
  // P waves along z: sqrt(3.2e9 / 1500) m/s.
  EXPECT_NEAR(json["wave_speeds"]["z"][0].get<double>(), 1460.593, 1e-3);
  EXPECT_EQ(json["cases"].size(), 6u);
  const std::string table = test::read_file(directory_ / "out/stiffness.csv");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 7);
  EXPECT_TRUE(std::filesystem::exists(directory_ / "out/resolved.toml"));
  EXPECT_EQ(json["boundary"], "periodic");
  EXPECT_LT(json["closest_transversely_isotropic"]["distance"], 1e-6);
  EXPECT_GT(json["closest_cubic"]["distance"], 0.1);
  EXPECT_EQ(json["islands"]["count"], 0);
  // Along the layers stresses are in the ratio of the moduli; across them they are the same.
  EXPECT_NEAR(json["phase_means"]["stiff"]["stress"][0][0].get<double>() / 8e9, 1, 1e-6);
  EXPECT_NEAR(json["phase_means"]["soft"]["stress"][2][2].get<double>() / 3.2e9, 1, 1e-6);
  // A header and three planes of 36 directions.
  const std::string directions = test::read_file(directory_ / "out/directions.csv");
  EXPECT_EQ(std::count(directions.begin(), directions.end(), '\n'), 1 + 3 * 36);

  // Again into the same directory, on two ranks, without a word: the same numbers.
  const Ended again = with("--out out --ranks 2 --quiet");
  EXPECT_EQ(again.code, 0) << again.error;
  EXPECT_EQ(again.output, "");
  const Json repeated = Json::parse(test::read_file(directory_ / "out/stiffness.json"));
  EXPECT_EQ(repeated["stiffness"], json["stiffness"]);
}

// Along layers of nu = 0 the strain is uniform where the faces follow it, or slide on plates: 5 GPa. Uniform forces on
// both layers stretch the soft one more, between the means of moduli, 5 GPa, and of compliances, 3.2 GPa.
TEST_F(HomogenizeCommand, OtherBoundariesNeedNoPeriod) {
  int compared = 0;
  for (const std::string boundary : {"displacement", "mixed", "traction"}) {
    const Ended ended = with("--set 'body.periodic=[]' --boundary " + boundary + " --out " + boundary);
    EXPECT_EQ(ended.code, 0) << ended.error;
    EXPECT_THAT(ended.output, HasSubstr("boundaries               "));
    const Json json = Json::parse(test::read_file(directory_ / boundary / "stiffness.json"));
    EXPECT_EQ(json["boundary"], boundary);
    for (const std::size_t i : {0, 1}) {
      const double along = json["stiffness"][i][i].get<double>() / 1e9;
      if (boundary == "traction") {
        EXPECT_GT(along, 3.2);
        EXPECT_LT(along, 4.9);
      } else {
        EXPECT_NEAR(along, 5, 1e-6);
      }
      ++compared;
    }
  }
  EXPECT_EQ(compared, 6);
  const Ended ended = with("--boundary sticky --out wrong");
  EXPECT_NE(ended.code, 0);
  EXPECT_THAT(ended.error, HasSubstr("sticky"));
}

// --coarser merges cells as body.scan.coarsen merges voxels; the extrapolation is that of an error of first order.
TEST_F(HomogenizeCommand, StudiesOfCellsAndBoxes) {
  std::string voxels;
  for (int k = 0; k < 8; ++k)
    for (int j = 0; j < 8; ++j)
      for (int i = 0; i < 8; ++i) voxels += static_cast<char>((i / 3 + 2 * (j / 3) + k / 4 * i) % 4 % 3);
  test::write_file(directory_ / "scan.raw", voxels);
  std::string text = layers;
  const auto replace = [&](const std::string& from, const std::string& to) {
    ASSERT_NE(text.find(from), std::string::npos);
    text.replace(text.find(from), from.size(), to);
  };
  replace(
      "size = [\"4 mm\", \"4 mm\", \"4 mm\"]\nmaterial = \"stiff\"",
      "image = \"scan.raw\"\nmaterials = { 0 = \"void\", 1 = \"stiff\", 2 = \"soft\" }\nscan = { size = [8, 8, 8] }");
  text.erase(text.find("[[region]]"), text.find("[analysis]") - text.find("[[region]]"));
  test::write_file(directory_ / "scan.toml", text);

  const Ended fine = koshi("homogenize scan.toml --coarser --boxes 3 --out fine");
  ASSERT_EQ(fine.code, 0) << fine.error;
  EXPECT_THAT(fine.output, HasSubstr("uncertainty"));
  const Ended coarse =
      koshi("homogenize scan.toml --set body.scan.coarsen=2 --set 'lattice.spacing=\"2 mm\"' --out coarse");
  ASSERT_EQ(coarse.code, 0) << coarse.error;
  const Json at_d = Json::parse(test::read_file(directory_ / "fine/stiffness.json"));
  const Json at_2d = Json::parse(test::read_file(directory_ / "coarse/stiffness.json"));
  int compared = 0;
  for (const char* modulus : {"bulk", "shear"}) {
    const double d = at_d["closest_isotropic"][modulus], d2 = at_2d["closest_isotropic"][modulus];
    const Json& study = at_d["coarser"];
    EXPECT_NEAR(study["closest_isotropic"][modulus].get<double>() / d2, 1, 1e-9);
    EXPECT_NEAR(study["extrapolated"][modulus].get<double>() / d, 2 - d2 / d, 1e-9);
    EXPECT_NEAR(study["uncertainty"][modulus].get<double>() / d, std::abs(1 - d2 / d), 1e-9);
    EXPECT_GT(std::abs(1 - d2 / d), 1e-3);
    ++compared;
  }
  EXPECT_EQ(compared, 2);
  EXPECT_NEAR(at_2d["density"].get<double>() / at_d["density"].get<double>(), 1, 0.2);
  // A header, and boxes of 4 cells; those of 2 would say nothing.
  const std::string table = test::read_file(directory_ / "fine/boxes.csv");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 2);
  EXPECT_THAT(table, HasSubstr("\n4,3,"));

  const Ended odd = koshi("homogenize scan.toml --coarser --set 'body.scan.crop={min=[0,0,0],max=[7,8,8]}' --out odd");
  EXPECT_EQ(odd.code, 2);
  EXPECT_THAT(odd.error, HasSubstr("the body has 7 x 8 x 8 cells, but those of twice the side need even numbers"));
}

TEST_F(HomogenizeCommand, RefusesWhatHasNoEffectiveStiffness) {
  const std::pair<const char*, const char*> wrong[] = {
      {"--set 'body.periodic=[\"x\",\"z\"]'", "not periodic in y"},
      {"--set 'lattice.springs=\"plain\"'", "plain springs"},
      {"--set 'load=[{name=\"g\",acceleration=[\"0 m/s^2\",\"0 m/s^2\",\"-9.81 m/s^2\"]}]'", "remove the loads"},
      {"--set 'boundary=[{name=\"b\",point=[\"0 mm\",\"0 mm\",\"0 mm\"],fix=[\"x\"]}]'", "remove the boundaries"},
      {"--set 'macroscopic={strain={xx=0.001}}'", "remove [macroscopic]"},
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
