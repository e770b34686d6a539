// What limits leave, and what is said when memory runs out.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <filesystem>
#include <limits>

#include "base/free_memory.h"
#include "base/out_of_memory.h"
#include "statics/petsc.h"
#include "support/program.h"
#include "support/temporary_directory.h"

namespace koshi {
namespace {

namespace fs = std::filesystem;
constexpr double unlimited = std::numeric_limits<double>::infinity();

void write(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  test::write_file(file, text);
}

// Version 2: the tightest group on the way up counts, and pages of files that nothing uses are free.
TEST(FreeMemory, OfControlGroupsVersionTwo) {
  const test::TemporaryDirectory root;
  write(root / "slurm/memory.max", "1000\n");
  write(root / "slurm/memory.current", "600\n");
  write(root / "slurm/memory.stat", "anon 450\ninactive_file 150\n");
  write(root / "slurm/job/memory.max", "max\n");
  write(root / "slurm/job/memory.current", "500\n");
  EXPECT_EQ(free_in_control_groups("0::/slurm/job\n", root.path()), 1000 - (600 - 150));
  write(root / "slurm/job/memory.max", "700\n");
  EXPECT_EQ(free_in_control_groups("0::/slurm/job\n", root.path()), 700 - 500);
  // More than the limit is used: nothing is left. A group that is not shown limits nothing, the root above it does.
  write(root / "slurm/job/memory.max", "400\n");
  EXPECT_EQ(free_in_control_groups("0::/slurm/job\n", root.path()), 0);
  EXPECT_EQ(free_in_control_groups("0::/other\n", root.path()), unlimited);
  write(root / "memory.max", "50\n");
  EXPECT_EQ(free_in_control_groups("0::/other\n", root.path()), 50);
  EXPECT_EQ(free_in_control_groups("0::/\n", root.path()), 50);
}

// Version 1: a hierarchy of its own, whose files have other names.
TEST(FreeMemory, OfControlGroupsVersionOne) {
  const test::TemporaryDirectory root;
  write(root / "memory/job/memory.limit_in_bytes", "9000\n");
  write(root / "memory/job/memory.usage_in_bytes", "2000\n");
  write(root / "memory/job/memory.stat", "inactive_file 1\ntotal_inactive_file 500\n");
  EXPECT_EQ(free_in_control_groups("5:cpu,cpuacct:/job\n4:memory:/job\n", root.path()), 9000 - (2000 - 500));
  EXPECT_EQ(free_in_control_groups("5:cpu,cpuacct:/job\n", root.path()), unlimited);
  EXPECT_EQ(free_in_control_groups("nonsense\n", root.path()), unlimited);
}

TEST(FreeMemory, OfTheAddressSpaceIsForEachRank) {
  if (!test::without_address_sanitizer) GTEST_SKIP() << "under the address sanitizer";
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_AS, &before), 0);
  rlimit limit = before;
  limit.rlim_cur = 3'000'000'000;
  ASSERT_EQ(setrlimit(RLIMIT_AS, &limit), 0);
  const FreeMemory one = free_memory(1);
  ASSERT_EQ(setrlimit(RLIMIT_AS, &before), 0);
  EXPECT_GT(one.bytes, 0);
  EXPECT_LT(one.bytes, 3e9);
}

TEST(OutOfMemory, SaysWhatWasBeingMade) {
  int caught = 0;
  const auto expect_said = [&](auto&& make) {
    try {
      while_making("the outer thing", [&] { while_making("the levels", make); });
    } catch (const std::bad_alloc& error) {
      EXPECT_STREQ(error.what(), "out of memory while making the levels; `koshi check` says how much a run takes");
      ++caught;
    }
  };
  expect_said([] { throw std::bad_alloc(); });
  expect_said([] { std::vector<double>().resize(std::numeric_limits<std::size_t>::max()); });
  expect_said([] { statics::check(PETSC_ERR_MEM); });
  EXPECT_EQ(caught, 3);
  EXPECT_EQ(while_making("a number", [] { return 7; }), 7);
}

}  // namespace
}  // namespace koshi
