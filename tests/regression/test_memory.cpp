// The memory of a run is what `koshi check` says, within a tenth of what the body takes. What libraries hold differs
// between machines: it is counted while the program runs.
#include <fmt/format.h>
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

// Runs each case and compares the growth of its memory with what the check of the case predicts.
void expect_predicted(const test::TemporaryDirectory& directory, const std::vector<std::string>& cases) {
  test::write_file(directory / "plain.toml", block);
  test::write_file(directory / "mixed.toml", block + spheres());
  for (const std::string& arguments : cases) {
    const test::Ended check = test::koshi(directory.path(), "check " + arguments);
    ASSERT_EQ(check.code, 0) << check.error;
    double total = 0, body = 0;
    ASSERT_EQ(std::sscanf(check.output.c_str() + check.output.find("\nmemory "),
                          " memory %lf GB, of it %lf GB for the body", &total, &body),
              2)
        << check.output;
    ASSERT_EQ(test::koshi(directory.path(), "run " + arguments + " --out out --quiet").code, 0);
    const auto summary = nlohmann::json::parse(test::read_file(directory / "out/summary.json"));
    const auto gigabytes = [&](const char* key) { return summary.at("performance").at(key).get<double>() / 1e9; };
    const double peak = gigabytes("peak_memory"), before = gigabytes("memory_before");
    // Pages of libraries' files that came in since are not the body's. Whether that was before or after the peak is
    // not known: the body took between `least` and `most`.
    const double files = gigabytes("library_growth"), most = peak - before, least = most - files;
    const std::string seen = fmt::format(
        "{}: predicted {:.4f} of {:.4f} GB, measured {:.4f} to {:.4f} of {:.4f} GB; {:.4f} GB before the body",
        arguments, body, total, least, most, peak, before);
    EXPECT_GT(body, 0.9 * least) << seen;
    EXPECT_LT(body, 1.1 * most) << seen;
    // The check holds the same libraries as the run before it makes the body, give or take a tenth.
    EXPECT_NEAR((total - body) / before, 1, 0.1) << seen;
    std::puts(seen.c_str());
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
