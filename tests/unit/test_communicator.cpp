// Collectives against values that each rank can work out alone. Run on three ranks.
#include <gtest/gtest.h>

#include <array>
#include <stdexcept>
#include <string>

#include "base/collective.h"
#include "base/memory.h"
#include "koshi/communicator.h"

namespace koshi {
namespace {

class CommunicatorTest : public testing::Test {
 protected:
  void SetUp() override { ASSERT_EQ(world.size(), 3); }
  const Communicator world = Communicator::world();
  const int rank = world.rank();
};

TEST_F(CommunicatorTest, Sum) {
  // 1 + 2 + 3 and 10 * (0 + 1 + 2)
  std::array<std::int64_t, 2> values{rank + 1, 10 * rank};
  world.sum(values);
  EXPECT_EQ(values[0], 6);
  EXPECT_EQ(values[1], 30);
  // Above 2^53, where doubles would lose the last digit: 3 * 2^60 + (0 + 1 + 2).
  EXPECT_EQ(world.sum((std::int64_t{1} << 60) + rank), 3 * (std::int64_t{1} << 60) + 3);
}

TEST_F(CommunicatorTest, Extremes) {
  EXPECT_EQ(world.max(-1.5 * rank), 0.0);
  EXPECT_EQ(world.min(-1.5 * rank), -3.0);
  EXPECT_TRUE(world.any(rank == 1));
  EXPECT_FALSE(world.any(false));
}

TEST_F(CommunicatorTest, BroadcastFromEveryRoot) {
  for (int root = 0; root < world.size(); ++root) {
    EXPECT_EQ(world.broadcast(std::string(static_cast<std::size_t>(rank), 'a'), root),
              std::string(static_cast<std::size_t>(root), 'a'));
    std::array<double, 2> values{1.0 * rank, 0.5};
    world.broadcast(values, root);
    EXPECT_EQ(values[0], 1.0 * root);
  }
}

TEST_F(CommunicatorTest, GatherKeepsRankOrder) {
  // Rank r sends r + 1 letters, one of them a zero byte: lengths differ and bytes are not text.
  const std::string mine = std::string(static_cast<std::size_t>(rank), static_cast<char>('a' + rank)) + '\0';
  EXPECT_EQ(world.gather(mine), rank == 0 ? std::string("\0b\0cc\0", 6) : "");
}

TEST_F(CommunicatorTest, HandleNamesTheSameRanks) {
  const Communicator same = Communicator::from_handle(world.handle());
  EXPECT_EQ(same.rank(), rank);
  EXPECT_EQ(same.sum(1), 3);
}

// What one rank throws, all throw: the first rank's, with its kind and place.
TEST_F(CommunicatorTest, ErrorsOfOneRankAreErrorsOfAll) {
  int input_errors = 0, run_errors = 0;
  for (int thrower = 0; thrower < world.size(); ++thrower) {
    try {
      collectively(world, [&] {
        if (rank >= thrower) throw InputError(Place{"case.toml", 3, 10 + rank}, "wrong");
      });
    } catch (const InputError& error) {
      ++input_errors;
      EXPECT_EQ(std::string(error.what()), "case.toml:3:" + std::to_string(10 + thrower) + ": error: wrong");
    }
    try {
      collectively(world, [&] {
        if (rank == thrower) throw std::length_error("too long");
      });
    } catch (const RunError& error) {
      ++run_errors;
      EXPECT_STREQ(error.what(), "too long");
    }
  }
  EXPECT_EQ(input_errors, 3);
  EXPECT_EQ(run_errors, 3);
  EXPECT_NO_THROW(collectively(world, [] {}));
}

TEST_F(CommunicatorTest, MemoryOfAllRanks) {
  const double mine = peak_memory(), all = peak_memory(world);
  EXPECT_GE(all, 3 * world.min(mine));
  // Peaks may grow a little between the two looks.
  EXPECT_LE(all, 3 * world.max(mine) + 1e7);
}

}  // namespace
}  // namespace koshi
