#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "base/exact_sum.h"

namespace koshi {
namespace {

double exact(const std::vector<double>& terms) {
  ExactSum sum;
  for (const double t : terms) sum += t;
  return sum.value();
}

TEST(ExactSum, CancelsWithoutLoss) {
  EXPECT_EQ(exact({1e300, 1.0, -1e300}), 1.0);
  EXPECT_EQ(exact({1e-300, 1e16, -1e16}), 1e-300);
  EXPECT_EQ(exact({}), 0.0);
  EXPECT_EQ(exact({-3.25}), -3.25);
  const double tiny = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(exact({tiny, tiny, tiny}), 3 * tiny);
  EXPECT_EQ(exact({std::numeric_limits<double>::max()}), std::numeric_limits<double>::max());
}

// 1 + 2^-53 + 2^-54 lies above the midpoint between 1 and its successor, so it rounds up; 1 + 2^-53 ties to even.
TEST(ExactSum, RoundsOnceToNearest) {
  EXPECT_EQ(exact({1.0, std::ldexp(1, -53), std::ldexp(1, -54)}), 1.0 + std::ldexp(1, -52));
  EXPECT_EQ(exact({1.0, std::ldexp(1, -53)}), 1.0);
  EXPECT_EQ(exact({1.0, std::ldexp(1, -53), std::ldexp(1, -500)}), 1.0 + std::ldexp(1, -52));
}

TEST(ExactSum, DoesNotDependOnTheOrder) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  std::vector<double> terms(10000);
  for (double& t : terms) t = normal(random) * std::exp(20 * normal(random));
  const double first = exact(terms);
  for (int i = 0; i < 5; ++i) {
    std::shuffle(terms.begin(), terms.end(), random);
    EXPECT_EQ(exact(terms), first);
  }
  long double reference = 0;
  std::sort(terms.begin(), terms.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
  for (const double t : terms) reference += t;
  EXPECT_NEAR(first, static_cast<double>(reference), 1e-14 * std::abs(terms.back()));
}

TEST(ExactSum, NotANumberStays) { EXPECT_TRUE(std::isnan(exact({1.0, std::numeric_limits<double>::infinity()}))); }

}  // namespace
}  // namespace koshi
