// Formulas of the input: values, and texts that are none.
#include "model/formula.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "koshi/error.h"

namespace koshi::model {
namespace {

using testing::HasSubstr;

TEST(Formula, Values) {
  struct Case {
    const char* text;
    double value;
  };
  // At x = 2, y = -3, z = 0.5, t = 4.
  const std::vector<Case> cases{
      {"1000 * 9.81 * (10 - z)", 93195},
      {"max(0, 10 - z) + min(x, y)", 6.5},
      {"x^2 + y^2 - -z", 13.5},
      {"2^3^2", 512},
      {"sin(pi/2) + cos(0) + exp(log(3)) + log10(100)", 7},
      {"sqrt(abs(y) * 3) - sign(y) + floor(z)", 4},
      {"atan2(1, 1) * 4 / pi + tanh(0)", 1},
      {"t > 3 && x < 3 ? 5 : 6", 5},
      {"t > 3 && x > 3 ? 5 : 6", 6},
      {"1e3*x", 2000},
      {" x ", 2},
  };
  for (const Case& c : cases)
    EXPECT_NEAR(Formula(c.text).at({2, -3, 0.5}, 4), c.value, 1e-12 * std::abs(c.value)) << c.text;
  EXPECT_TRUE(Formula("x + 0*t").varies_in_time());
  EXPECT_FALSE(Formula("x + atan2(y, z)").varies_in_time());
}

TEST(Formula, MovesWithItsPlace) {
  Formula first("x + t");
  const Formula second = std::move(first);
  EXPECT_EQ(second.at({1, 0, 0}, 2), 3);
  EXPECT_EQ(second.at({5, 0, 0}, 0), 5);
}

TEST(Formula, SaysWhereItGoesWrong) {
  struct Case {
    std::string text, message;
  };
  const std::string nest(400, '(');
  const std::vector<Case> cases{
      {"10 - q", "the formula has the unknown name or sign \"q\" at character 6; known: x, y, z [m], t [s], pi"},
      {"10 - depth * 2", "unknown name or sign \"depth\" at character 6"},
      {"(10 - z", "a parenthesis that is not closed at character 8"},
      {"10 - z)", "a parenthesis too many at character 7"},
      {"10 -", "ends too early at character 5"},
      {"", "at character 1"},
      {"   ", "at character"},
      {"x = 3", "has an = that compares nothing (equal is ==) at character 3"},
      {"max(1)", "too few values"},
      {"sin(1, 2)", "too many values"},
      {"1, 2", "the formula has 2 values; give one"},
      {"\"a\"", "has a character that no formula has at character 1"},
      {"x;y", "has a character that no formula has at character 2"},
      {"3 \xc2\xb7 x", "has a character that no formula has at character 3"},
      {std::string("x\0y", 3), "has a character that no formula has at character 2"},
      {"%n%n%s", "has a character that no formula has"},
      {"x y", "at character 3"},
      {"2x", "at character 2"},
      {"10 MPa", "\"MPa\" at character 4"},
      {"rnd(3)", "\"rnd\""},
      {"_e", "\"_e\""},
      {"x ? 1", "at character"},
      {"1 : 2", "at character"},
      {"* 3", "at character"},
      {"sin", "at character"},
      {"()", "at character"},
      {",", "at character"},
      {"1 <=> 2", "at character"},
      {nest, "at character"},
      {std::string(1001, '1'), "has 1001 characters; at most 1000 are read"},
  };
  for (const Case& c : cases) {
    try {
      const Formula formula(c.text);
      ADD_FAILURE() << c.text << " was read as " << formula.at({}, 0);
    } catch (const InputError& error) {
      EXPECT_THAT(error.message(), HasSubstr(c.message)) << c.text;
      EXPECT_LT(error.message().size(), 700u) << c.text;
    }
  }
}

TEST(Formula, TakesWhatIsDeepAndLong) {
  const auto repeated = [](const std::string& text, std::size_t times) {
    std::string all;
    for (std::size_t i = 0; i < times; ++i) all += text;
    return all;
  };
  EXPECT_EQ(Formula(repeated("(", 400) + "x" + repeated(")", 400)).at({7, 0, 0}, 0), 7);
  EXPECT_EQ(Formula(repeated("abs(", 190) + "x" + repeated(")", 190)).at({-7, 0, 0}, 0), 7);
  EXPECT_EQ(Formula(repeated("-(", 300) + "x" + repeated(")", 300)).at({7, 0, 0}, 0), 7);
  EXPECT_EQ(Formula(repeated("x>1?", 100) + "2" + repeated(":3", 100)).at({7, 0, 0}, 0), 2);
  EXPECT_EQ(Formula(repeated("1+", 400) + "x").at({7, 0, 0}, 0), 407);
  EXPECT_TRUE(std::isinf(Formula("9^9^9^9").at({}, 0)));
  EXPECT_TRUE(std::isnan(Formula("x/y").at({}, 0)));
}

}  // namespace
}  // namespace koshi::model
