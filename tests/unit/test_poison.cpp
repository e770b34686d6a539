// What debug builds put where nothing has been written yet.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "base/poison.h"

namespace koshi {
namespace {

template <class T>
int count_poisoned() {
  std::array<T, 5> values{1, 2, 3, 4, 5};
  poison(values.data() + 1, 3 * sizeof(T));
  EXPECT_EQ(values.front(), 1);
  EXPECT_EQ(values.back(), 5);
  int count = 0;
  for (const T value : values) count += std::isnan(value);
  return count;
}

TEST(Poison, IsNotANumberInDebugBuildsAndNothingInOthers) {
  EXPECT_EQ(count_poisoned<double>(), poisons ? 3 : 0);
  EXPECT_EQ(count_poisoned<float>(), poisons ? 3 : 0);
}

}  // namespace
}  // namespace koshi
