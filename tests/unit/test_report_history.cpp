// What a report draws over time: histories as they are read, and curves of the catalogue of events.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "io/files.h"
#include "io/history_reader.h"
#include "report/events.h"
#include "support/temporary_directory.h"

namespace koshi::report {
namespace {

using json = nlohmann::ordered_json;
using testing::ElementsAre;

// Three events: all are as large as the least, one as the largest. With b = 0.5 three become one over log10(3)/0.5.
TEST(Events, AreCountedByMagnitudeAndSummedOverTime) {
  const std::vector<io::HistoryColumn> events{
      {"time", "s", {1, 2, 4}}, {"energy", "J", {5, 1, 2}}, {"magnitude", "1", {-1, -3, -2}}};
  const json curves = event_curves(events, 0.5);
  ASSERT_EQ(curves.size(), 2u);
  const json& numbers = curves[0].at("series");
  ASSERT_EQ(numbers.size(), 2u);
  EXPECT_EQ(numbers[0].at("x"), json({-3, -2, -1}));
  EXPECT_EQ(numbers[0].at("y"), json({3, 2, 1}));
  EXPECT_NEAR(numbers[1].at("x")[1].get<double>(), -3 + std::log10(3) / 0.5, 1e-12);
  EXPECT_EQ(numbers[1].at("y"), json({3, 1}));
  EXPECT_EQ(curves[0].at("y").at("log"), true);
  EXPECT_EQ(curves[1].at("series")[0].at("y"), json({5, 6, 8}));
  EXPECT_EQ(event_curves(events, json())[0].at("series").size(), 1u);
  EXPECT_EQ(event_curves(std::vector<io::HistoryColumn>{{"time", "s", {}}, {"energy", "J", {}}}, json()).size(), 0u);
}

TEST(HistoryReader, QuotedNamesUnitsAndARowCutShort) {
  const test::TemporaryDirectory directory;
  io::replace_file(directory / "history.csv", "time [s],\"a, \"\"b\"\" [m]\",plain\n1,2.5,nan\n3,-4e-3,7\n5,6");
  const auto columns = io::read_history(directory / "history.csv");
  ASSERT_EQ(columns.size(), 3U);
  EXPECT_EQ(columns[1].name, "a, \"b\"");
  EXPECT_EQ(columns[1].unit, "m");
  EXPECT_EQ(columns[2].unit, "1");
  EXPECT_THAT(columns[1].values, ElementsAre(2.5, -4e-3));
  EXPECT_TRUE(std::isnan(columns[2].values.at(0)));
}

}  // namespace
}  // namespace koshi::report
