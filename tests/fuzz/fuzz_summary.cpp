// The report of a run against arbitrary summaries: a report, or an InputError.
#include <fstream>
#include <nlohmann/json.hpp>

#include "koshi/error.h"
#include "report/report.h"
#include "support/temporary_directory.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const koshi::test::TemporaryDirectory directory;
  static const bool written = static_cast<bool>(std::ofstream(directory / "resolved.toml") << R"([lattice]
spacing = 1
[body]
size = [1, 1, 1]
material = "rock"
[material.rock]
youngs_modulus = 1e9
poissons_ratio = 0.2
density = 1000
[[boundary]]
face = "x-min"
fix = ["x", "y", "z", "rx", "ry", "rz"]
[[probe]]
name = "tip"
face = "x-max"
)");
  std::ofstream(directory / "summary.json", std::ios::binary | std::ios::trunc)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  try {
    if (written) koshi::report::report_data(directory.path());
  } catch (const koshi::InputError&) {
  }
  return 0;
}
