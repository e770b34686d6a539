// The progress line, its clock, and messages beside it.
#include "base/progress.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <vector>

#include "base/log.h"
#include "base/memory.h"

namespace koshi {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

class ProgressTest : public testing::Test {
 protected:
  Console console(bool terminal) {
    return Console([this](std::string_view text) { written.emplace_back(text); }, terminal, [this] { return width; });
  }
  Progress::Clock clock() {
    return [this] { return now; };
  }
  std::vector<std::string> written;
  double now = 1000;
  int width = 200;
};

TEST_F(ProgressTest, TerminalLineHasBarDetailsAndRemainingTime) {
  Console out = console(true);
  Progress progress(false, "compression", out, clock());
  progress.update(0, "0/1000 steps");
  now += 60;
  progress.update(0.25, "250/1000 steps, 4.2 steps/s");
  // A quarter in 60 s: three more take 180 s. 6 of the 24 columns of the bar are full.
  EXPECT_EQ(written.back(),
            "\r\x1b[Kcompression [======>                 ]  25 %  250/1000 steps, 4.2 steps/s  ETA 0:03:00");
  progress.finish("compression: done in 240 s");
  EXPECT_EQ(written.size(), 4u);
  EXPECT_EQ(written[2], "\r\x1b[K");
  EXPECT_EQ(written[3], "compression: done in 240 s\n");
}

TEST_F(ProgressTest, RemainingTimeOfARestartCountsFromItsStart) {
  Console out = console(false);
  Progress progress(false, "run", out, clock());
  progress.update(0.5, "");
  now += 10;
  progress.update(0.6, "");
  // A tenth in 10 s: four more take 40 s (60 % in 10 s would give 7 s).
  EXPECT_EQ(written.back(), "run  60 %    ETA 40 s\n");
}

TEST_F(ProgressTest, TerminalIsDrawnAtMostTenTimesASecond) {
  Console out = console(true);
  Progress progress(false, "run", out, clock());
  int due = 0;
  // 10 s in steps of 1/128 s: redrawn after every 13 steps (0.1016 s), 1281 / 13 = 98.5.
  for (int i = 0; i <= 1280; ++i, now += 1.0 / 128) {
    due += progress.due();
    progress.update(i / 2000.0, "");
  }
  EXPECT_EQ(written.size(), 99u);
  EXPECT_EQ(due, 99);
}

TEST_F(ProgressTest, PipeGetsALineEveryTenSeconds) {
  Console out = console(false);
  {
    Progress progress(false, "run", out, clock());
    for (int i = 0; i <= 35; ++i, now += 1) progress.update(i / 100.0, "x");
    progress.finish("run: done");
  }
  // At 0, 10, 20 and 30 s, and the end. After 10 s and 10 % the other 90 % take 90 s.
  ASSERT_EQ(written.size(), 5u);
  EXPECT_EQ(written[0], "run   0 %  x\n");
  EXPECT_EQ(written[1], "run  10 %  x  ETA 0:01:30\n");
  EXPECT_EQ(written[4], "run: done\n");
  for (const std::string& line : written) EXPECT_THAT(line, Not(HasSubstr("\x1b")));
}

TEST_F(ProgressTest, UnknownLengthShowsTheTimeSoFar) {
  Console out = console(true);
  Progress progress(false, "equilibrium", out, clock());
  progress.update(-1, "residual 1e-2");
  now += 75;
  progress.update(-1, "residual 1e-3");
  EXPECT_EQ(written.back(), "\r\x1b[Kequilibrium  residual 1e-3  0:01:15");
}

TEST_F(ProgressTest, HundredPercentOnlyWhenDone) {
  Console out = console(true);
  Progress progress(false, "run", out, clock());
  progress.update(0.9999, "");
  EXPECT_THAT(written.back(), HasSubstr(" 99 %"));
  now += 1;
  progress.update(1, "");
  EXPECT_THAT(written.back(), HasSubstr("[========================] 100 %"));
  EXPECT_THAT(written.back(), Not(HasSubstr("ETA")));
}

TEST_F(ProgressTest, QuietPrintsNothing) {
  Console out = console(true);
  {
    Progress progress(true, "run", out, clock());
    EXPECT_FALSE(progress.due());
    progress.update(0.5, "x");
    progress.finish("done");
  }
  EXPECT_THAT(written, testing::IsEmpty());
}

TEST_F(ProgressTest, LiveLineIsClearedWhenARunIsLeftByAnError) {
  Console out = console(true);
  { Progress(false, "run", out, clock()).update(0.5, ""); }
  EXPECT_EQ(written.back(), "\r\x1b[K");
}

TEST_F(ProgressTest, MessagesGoAboveTheLiveLine) {
  Console out = console(true);
  out.print("before");
  out.show("live");
  out.print("message");
  out.show("");
  out.show("");
  out.print("after");
  EXPECT_THAT(written, ElementsAre("before\n", "\r\x1b[Klive", "\r\x1b[Kmessage\nlive", "\r\x1b[K", "after\n"));
}

TEST_F(ProgressTest, LiveLineIsCutToTheTerminal) {
  Console out = console(true);
  width = 6;
  out.show("0123456789");
  EXPECT_EQ(written.back(), "\r\x1b[K01234");
  // Five columns hold one character of three bytes, not half of the next.
  out.show("\u683c\u5b50\u683c");
  EXPECT_EQ(written.back(), "\r\x1b[K\u683c");
}

TEST(DurationText, ForPeople) {
  EXPECT_EQ(duration_text(0.4), "0 s");
  EXPECT_EQ(duration_text(59.4), "59 s");
  EXPECT_EQ(duration_text(59.6), "0:01:00");
  EXPECT_EQ(duration_text(3600 * 5 + 61), "5:01:01");
  EXPECT_EQ(duration_text(86400 * 3 + 3600 * 4 + 300), "3 d 04:05");
  EXPECT_EQ(duration_text(std::numeric_limits<double>::infinity()), "unknown");
  EXPECT_EQ(duration_text(std::nan("")), "unknown");
}

TEST(Log, LevelsSilence) {
  testing::internal::CaptureStderr();
  log_information("one");
  log_warning("two");
  set_log_level({.information = false, .warnings = true});
  log_information("three");
  log_warning("four");
  set_log_level({.information = false, .warnings = false});
  log_warning("five");
  set_log_level({});
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "one\nwarning: two\nwarning: four\n");
}

TEST(Memory, PeakGrowsByWhatIsTouched) {
  const double before = peak_memory();
  EXPECT_GT(before, 1e6);
  constexpr std::size_t size = std::size_t{256} << 20;
  std::vector<char> block(size, 1);
  // The process may have held more before than at the start of this test, but not more than its peak.
  EXPECT_GT(peak_memory(), before + 0.5 * size);
  EXPECT_LT(peak_memory(), before + 1.5 * size);
  EXPECT_NE(std::accumulate(block.begin(), block.end(), 0), 0);
}

}  // namespace
}  // namespace koshi
