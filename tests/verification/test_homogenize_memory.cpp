// Memory of the six cases of a mixed body, in units of its displacements.
#include <gtest/gtest.h>
#include <malloc.h>

#include <cmath>
#include <fstream>
#include <string>

#include "support/periodic_block.h"

namespace koshi {
namespace {

// A number of /proc/self/status [bytes].
double status(const std::string& key) {
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with(key)) return 1024 * std::stod(line.substr(key.size() + 1));
  ADD_FAILURE() << "no " << key;
  return 0;
}

// By how many bytes the memory of the process grows at most while the six cases are solved.
double growth(std::int64_t n) {
  const Int3 cells{n, n, n};
  model::Definition definition = test::periodic_block(cells);
  definition.analysis.tolerance = 0.1;
  // Balls of void on a lattice of eight cells, 18 % of the body; nearly all groups of nodes meet one.
  std::int64_t voids = 0;
  test::fill(definition, cells, [&](const Int3& c) {
    double square = 0;
    for (const std::int64_t at : c) square += std::pow(static_cast<double>(at % 8) - 3.5, 2);
    // A cell of another material here and there, so that hardly two rows are alike.
    const bool stiff = (c[0] * 7 + c[1] * 13 + c[2] * 29) % 31 == 0;
    voids += square < 8;
    return square < 8 ? 0 : stiff ? 3 : 1;
  });
  EXPECT_GT(voids, n * n * n / 8);
  const model::Model model = model::make_model(definition, Communicator::self());
  statics::StaticOptions options;
  options.tolerance = definition.analysis.tolerance;
  // What is free goes back to the system, and the high-water mark starts anew.
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << 5;
  const double before = status("VmRSS:");
  EXPECT_LT(homogenize::effective_stiffness(model, options).cases[0].relative_residual, 0.1);
  return status("VmHWM:") - before;
}

TEST(HomogenizeMemory, IsThatOfFewFields) {
  // Displacements are 1; four fields in single precision with ghosts and padding are 2.2, coarser levels 0.3, what is
  // kept of five cases 0.6, node blocks of two bytes an element less than 1, since groups without an interface have
  // none of their own: 4.9 in all. In double precision six vectors, the levels and blocks of four bytes an
  // element would be 9. Both bodies have the same coarsest level, whose memory drops out of the difference, and what
  // libraries take at their first use with it.
  growth(32);
  const double few = growth(32), many = growth(64);
  const double displacements = 48.0 * (64.0 * 64 * 64 - 32.0 * 32 * 32);
  EXPECT_GT((many - few) / displacements, 3.2);
  EXPECT_LT((many - few) / displacements, 5.6);
}

}  // namespace
}  // namespace koshi
