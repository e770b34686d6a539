// main() of the test programs that run on several ranks: every rank runs the same tests, the root prints.
#include <gtest/gtest.h>

#include "koshi/communicator.h"

int main(int argc, char** argv) {
  koshi::Environment environment(&argc, &argv);
  testing::InitGoogleTest(&argc, argv);
  const auto world = koshi::Communicator::world();
  auto& listeners = testing::UnitTest::GetInstance()->listeners();
  if (!world.is_root()) delete listeners.Release(listeners.default_result_printer());
  const bool failed = RUN_ALL_TESTS() != 0;
  // A failure on a silent rank still fails the program and says where it was.
  if (failed && !world.is_root()) fprintf(stderr, "tests failed on rank %d\n", world.rank());
  return world.any(failed) ? 1 : 0;
}
