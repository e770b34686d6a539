// Collectives against values that each rank can work out alone. Run on three ranks.
#include <gtest/gtest.h>

#include <array>

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

}  // namespace
}  // namespace koshi
