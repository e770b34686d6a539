#include "base/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "base/escape.h"

namespace koshi {
namespace {

constexpr double live_interval = 0.1, line_interval = 10;  // [s]
constexpr int bar_width = 24;

std::string bar(double fraction) {
  const int full = static_cast<int>(fraction * bar_width);
  std::string text(static_cast<std::size_t>(full), '=');
  if (full < bar_width) text += '>';
  return fmt::format("[{:<{}}]", text, bar_width);
}

}  // namespace

double steady_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::string duration_text(double seconds) {
  if (!(seconds >= 0 && seconds < 1e10)) return "unknown";
  const auto s = static_cast<long long>(std::llround(seconds));
  const long long minutes = s / 60 % 60, hours = s / 3600;
  if (s < 60) return fmt::format("{} s", s);
  if (hours < 24) return fmt::format("{}:{:02}:{:02}", hours, minutes, s % 60);
  return fmt::format("{} d {:02}:{:02}", hours / 24, hours % 24, minutes);
}

Progress::Progress(bool quiet, std::string what, Console& console, Clock clock)
    : quiet_(quiet),
      what_(escaped(what)),
      console_(console),
      clock_(std::move(clock)),
      start_time_(clock_()),
      next_(start_time_) {}

Progress::~Progress() {
  if (!quiet_) console_.show("");
}

bool Progress::due() const { return !quiet_ && clock_() >= next_; }

void Progress::update(double fraction, std::string_view details) {
  if (quiet_) return;
  if (start_fraction_ < 0 && fraction >= 0) {
    start_fraction_ = fraction;
    start_time_ = clock_();
  }
  if (!due()) return;
  next_ = clock_() + (console_.terminal() ? live_interval : line_interval);
  if (console_.terminal())
    console_.show(text(fraction, details));
  else
    console_.print(text(fraction, details));
}

void Progress::finish(std::string_view line) {
  if (quiet_) return;
  console_.show("");
  if (!line.empty()) console_.print(line);
}

std::string Progress::text(double fraction, std::string_view details) const {
  const double elapsed = clock_() - start_time_;
  if (!(fraction >= 0)) return fmt::format("{}  {}  {}", what_, details, duration_text(elapsed));
  fraction = std::min(fraction, 1.0);
  std::string line = what_;
  if (console_.terminal()) line += ' ' + bar(fraction);
  // Rounded down: 100 % only when done.
  line += fmt::format(" {:3.0f} %  {}", std::floor(100 * fraction), details);
  const double done = fraction - start_fraction_;
  if (elapsed > 0 && done > 0 && fraction < 1)
    line += fmt::format("  ETA {}", duration_text(elapsed * (1 - fraction) / done));
  return line;
}

}  // namespace koshi
