// The memory of a run is what `koshi check` says, within a tenth.
#include <gtest/gtest.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <vector>

#include "support/program.h"
#include "support/temporary_directory.h"

namespace koshi {
namespace {

const std::string block = R"([lattice]
spacing = "1 mm"
[body]
size = ["64 mm", "30 mm", "40 mm"]
material = "rock"
[material.rock]
youngs_modulus = "25 GPa"
poissons_ratio = 0.2
density = 2000
[material.clay]
youngs_modulus = "2 GPa"
poissons_ratio = 0.2
density = 2000
[[boundary]]
name = "bottom"
face = "z-min"
fix = ["x", "y", "z", "rx", "ry", "rz"]
[[load]]
name = "top"
face = "z-max"
traction = ["1 MPa", 0, "-5 MPa"]
[analysis]
type = "static"
tolerance = 1e-4
)";

// Spheres everywhere: most groups of nodes meet an interface.
std::string spheres() {
  std::string text;
  for (int n = 0; n < 150; ++n)
    text += "[[region]]\nshape = \"sphere\"\nmaterial = \"clay\"\nradius = \"" + std::to_string(2 + n % 3) +
            " mm\"\ncenter = [\"" + std::to_string(n * 37 % 64) + " mm\", \"" + std::to_string(n * 23 % 30) +
            " mm\", \"" + std::to_string(n * 29 % 40) + ".5 mm\"]\n";
  return text;
}

// Runs each case and compares the peak of its memory with what the check of the case predicts.
void expect_predicted(const test::TemporaryDirectory& directory, const std::vector<std::string>& cases) {
  test::write_file(directory / "plain.toml", block);
  test::write_file(directory / "mixed.toml", block + spheres());
  for (const std::string& arguments : cases) {
    const test::Ended check = test::koshi(directory.path(), "check " + arguments);
    ASSERT_EQ(check.code, 0) << check.error;
    double predicted = 0;
    ASSERT_EQ(std::sscanf(check.output.c_str() + check.output.find("\nmemory "), " memory %lf GB", &predicted), 1);
    ASSERT_EQ(test::koshi(directory.path(), "run " + arguments + " --out out --quiet").code, 0);
    const auto summary = nlohmann::json::parse(test::read_file(directory / "out/summary.json"));
    const double peak = summary.at("performance").at("peak_memory").get<double>();
    EXPECT_NEAR(predicted * 1e9 / peak, 1, 0.1) << arguments << ": " << peak / 1e9 << " GB";
  }
}

TEST(StaticMemory, IsPredictedWithinATenth) {
  const test::TemporaryDirectory directory;
  expect_predicted(directory,
                   {"plain.toml", "plain.toml --set 'lattice.spacing=\"0.5 mm\"'",
                    "plain.toml --set 'lattice.spacing=\"0.5 mm\"' --set 'lattice.kinematics=\"least-squares\"'",
                    "mixed.toml --set 'lattice.spacing=\"0.5 mm\"'"});
}

TEST(ExplicitMemory, IsPredictedWithinATenth) {
  const test::TemporaryDirectory directory;
  const std::string few_steps =
      " --set 'analysis.type=\"dynamic\"' --set 'analysis.duration=\"0.3 us\"' --set 'output.fields=";
  const std::string fine = " --set 'lattice.spacing=\"0.5 mm\"'", finer = " --set 'lattice.spacing=\"0.4 mm\"'";
  expect_predicted(directory,
                   {"plain.toml" + few_steps + "[]'", "plain.toml" + few_steps + "[]'" + finer,
                    "plain.toml" + few_steps + "[]'" + finer + " --set 'lattice.kinematics=\"least-squares\"'",
                    "mixed.toml" + few_steps + "[]'" + fine,
                    "plain.toml" + few_steps + "[\"displacement\", \"stress\", \"energy\"]'" + fine});
}

}  // namespace
}  // namespace koshi
