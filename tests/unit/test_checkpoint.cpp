// Checkpoints written and read on one, two and three ranks; full disks. Run on three ranks.
#include "io/checkpoint.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mount.h>

#include <cmath>
#include <fstream>

#include "io/files.h"
#include "support/checkpoint_body.h"
#include "support/file_size_limit.h"
#include "support/first_ranks.h"
#include "support/temporary_directory.h"

namespace koshi::io {
namespace {

namespace fs = std::filesystem;
using test::fill;
using test::is_filled;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

const std::string case_text = "[lattice]\nspacing = 0.25\n";

CheckpointInfo make_info() {
  CheckpointInfo info;
  info.case_text = case_text;
  info.scalars = {{"kinetic energy", 1.0 / 3}, {"work.of/loads", -0.0}, {"not a number", std::nan("")}};
  info.blob = std::string("\0bytes\0", 7);
  return info;
}

class CheckpointTest : public testing::Test {
 protected:
  const Communicator world = Communicator::world();
  const test::TemporaryDirectory directory{world};
  const model::Model model = model::make_model(test::checkpoint_definition(), world);

  void write(std::int64_t step, const fs::path& place) {
    model::State state(model);
    fill(model, state, step);
    write_checkpoint(place, model, state, make_info());
  }
  void write(std::int64_t step) { write(step, directory.path()); }
  // True if the file is the checkpoint of this step.
  bool holds(const fs::path& file, std::int64_t step) {
    model::State state(model);
    read_checkpoint(file, model, case_text, state);
    return !world.any(!is_filled(model, state, step));
  }
};

// {ranks that write, ranks that read, periodic}
class CheckpointRanks : public testing::TestWithParam<std::tuple<int, int, bool>> {};

TEST_P(CheckpointRanks, ReadBackIsWhatWasWritten) {
  const auto [writers, readers, periodic] = GetParam();
  const Communicator world = Communicator::world();
  const test::TemporaryDirectory directory(world);
  const auto definition = test::checkpoint_definition(periodic);
  if (const auto group = test::first_ranks(writers)) {
    const model::Model model = model::make_model(definition, *group);
    model::State state(model);
    fill(model, state, 12345678901234);
    lattice::Field<double> orientation(model.layout(), 4);
    fill(model, orientation, 77);
    write_checkpoint(directory.path(), model, state, make_info(),
                     std::array{CheckpointField{"orientation", &orientation}});
  }
  world.barrier();
  if (const auto group = test::first_ranks(readers)) {
    const model::Model model = model::make_model(definition, *group);
    model::State state(model);
    lattice::Field<double> orientation(model.layout(), 4);
    const std::int64_t ghost = model.layout().index(-1, 0, 0);
    state.displacement.component(0)[ghost] = 42;
    const CheckpointInfo info = read_checkpoint(directory / "checkpoint.h5", model, case_text, state,
                                                std::array{CheckpointField{"orientation", &orientation}});
    EXPECT_TRUE(is_filled(model, state, 12345678901234));
    EXPECT_EQ(test::count_filled(model, orientation, 77), 4 * model.layout().owned_count());
    EXPECT_EQ(group->sum(model.layout().owned_count()), 8 * 6 * (periodic ? 6 : 7));
    EXPECT_EQ(state.displacement.component(0)[ghost], 42);
    EXPECT_EQ(info.time, state.time);
    EXPECT_EQ(info.step, 12345678901234);
    EXPECT_EQ(info.case_text, case_text);
    EXPECT_EQ(info.blob, std::string("\0bytes\0", 7));
    EXPECT_EQ(info.koshi_version, KOSHI_VERSION);
    ASSERT_EQ(info.scalars.size(), 3u);
    EXPECT_EQ(info.scalars.at("kinetic energy"), 1.0 / 3);
    EXPECT_TRUE(std::signbit(info.scalars.at("work.of/loads")));
    EXPECT_TRUE(std::isnan(info.scalars.at("not a number")));
    EXPECT_EQ(read_checkpoint_header(directory.path(), *group).step, info.step);
  }
}

INSTANTIATE_TEST_SUITE_P(Ranks, CheckpointRanks,
                         testing::Combine(testing::Values(1, 2, 3), testing::Values(1, 2, 3), testing::Bool()));

TEST_F(CheckpointTest, FileDoesNotDependOnTheRanks) {
  std::vector<std::string> files;
  for (int ranks = 1; ranks <= 3; ++ranks) {
    if (const auto group = test::first_ranks(ranks)) {
      const model::Model part = model::make_model(test::checkpoint_definition(), *group);
      model::State state(part);
      fill(part, state, 5);
      write_checkpoint(directory.path(), part, state, make_info());
    }
    world.barrier();
    files.push_back(read_file(directory / "checkpoint.h5"));
    world.barrier();
  }
  EXPECT_EQ(files[0], files[1]);
  EXPECT_EQ(files[0], files[2]);
  // 336 nodes, 12 components; the space reserved beyond is given back.
  EXPECT_GT(files[0].size(), 8u * 336 * 12);
  EXPECT_LT(files[0].size(), 8u * 336 * 12 + 16384);
}

TEST_F(CheckpointTest, LastTwoAreKept) {
  for (int step = 1; step <= 3; ++step) write(step);
  EXPECT_TRUE(holds(directory / "checkpoint.h5", 3));
  EXPECT_TRUE(holds(directory / "checkpoint.previous.h5", 2));
  EXPECT_EQ(std::distance(fs::directory_iterator(directory.path()), fs::directory_iterator()), 2);
}

TEST_F(CheckpointTest, LeftoversOfAKilledRunDoNotMatter) {
  write(1);
  write(2);
  // Killed while writing, and between the two steps of the renaming.
  if (world.is_root()) {
    replace_file(directory / "checkpoint.h5.part", std::string(100000, 'x'));
    fs::remove(directory / "checkpoint.previous.h5");
    fs::create_hard_link(directory / "checkpoint.h5", directory / "checkpoint.previous.h5");
  }
  world.barrier();
  write(3);
  EXPECT_TRUE(holds(directory / "checkpoint.h5", 3));
  EXPECT_TRUE(holds(directory / "checkpoint.previous.h5", 2));
  EXPECT_FALSE(fs::exists(directory / "checkpoint.h5.part"));
}

TEST_F(CheckpointTest, LostDirectoryIsAnErrorWithTheSystemsReason) {
  EXPECT_THAT([&] { write(1, directory / "lost"); },
              ThrowsMessage<RunError>(AllOf(HasSubstr("cannot write"), HasSubstr("lost/checkpoint.h5"),
                                            HasSubstr("No such file or directory"))));
  EXPECT_THAT([&] { write(1, "/proc"); }, ThrowsMessage<RunError>(HasSubstr("cannot write /proc/checkpoint.h5")));
}

TEST_F(CheckpointTest, FileThatMayNotGrowIsAnErrorAndTheOlderOnesStay) {
  write(1);
  write(2);
  {
    const test::FileSizeLimit limit(30000);
    EXPECT_THAT([&] { write(3); }, ThrowsMessage<RunError>(HasSubstr("File too large")));
  }
  EXPECT_TRUE(holds(directory / "checkpoint.h5", 2));
  EXPECT_TRUE(holds(directory / "checkpoint.previous.h5", 1));
  EXPECT_FALSE(fs::exists(directory / "checkpoint.h5.part"));
  world.barrier();
  write(4);
  EXPECT_TRUE(holds(directory / "checkpoint.h5", 4));
}

TEST_F(CheckpointTest, FullDiskIsAnErrorAndTheOlderOnesStay) {
  const fs::path place = directory / "mount";
  bool mounted = true;
  if (world.is_root()) {
    fs::create_directory(place);
    mounted = ::mount("koshi", place.c_str(), "tmpfs", 0, "size=256k") == 0;
  }
  if (world.any(!mounted)) GTEST_SKIP() << "no right to mount a file system";
  // A checkpoint takes about 35 KB and asks for 100: after two there is room for one more. With 100 KB of something
  // else there is none.
  write(1, place);
  write(2, place);
  for (int round = 0; round < 3; ++round) {
    if (world.is_root())
      std::ofstream(place / "filler") << std::string(static_cast<std::size_t>(100000 + 50000 * round), 'x');
    world.barrier();
    EXPECT_THAT([&] { write(3, place); }, ThrowsMessage<RunError>(HasSubstr("No space left on device")));
    EXPECT_TRUE(holds(place / "checkpoint.h5", 2));
    EXPECT_TRUE(holds(place / "checkpoint.previous.h5", 1));
    EXPECT_FALSE(fs::exists(place / "checkpoint.h5.part"));
    world.barrier();
  }
  if (world.is_root()) fs::remove(place / "filler");
  world.barrier();
  write(4, place);
  EXPECT_TRUE(holds(place / "checkpoint.h5", 4));
  world.barrier();
  if (world.is_root()) ::umount(place.c_str());
}

}  // namespace
}  // namespace koshi::io
