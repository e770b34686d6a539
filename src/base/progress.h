// How far a run is: one live line on a terminal, a line now and then in a pipe.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "base/console.h"

namespace koshi {

/// Seconds of a clock that never goes back.
double steady_seconds();

/// On a terminal:  "compression [=======>    ]  42 %  1200/3000 steps, 812 steps/s  ETA 0:02:13", at most ten times a
/// second, cleared at the end; in a pipe the same without the bar, at the start and every ten seconds.
class Progress {
 public:
  using Clock = std::function<double()>;

  /// `quiet`: prints nothing; so must all ranks but the root.
  Progress(bool quiet, std::string what, Console& console = Console::standard(), Clock clock = steady_seconds);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// True when the next update() will be seen: ask before working out costly details.
  bool due() const;
  /// `fraction` done, 0 ... 1, negative if unknown (then there is no bar and no ETA, but the time so far); `details`
  /// such as counts, rate, residual. The remaining time is worked out from the first fraction and its time.
  void update(double fraction, std::string_view details);
  /// Clears the live line and prints this one; an empty one prints nothing.
  void finish(std::string_view line);

 private:
  std::string text(double fraction, std::string_view details) const;

  bool quiet_;
  std::string what_;
  Console& console_;
  Clock clock_;
  double start_time_;
  double start_fraction_ = -1;  // negative: not known yet
  double next_;                 // time of the next update that is seen
};

/// "7 s", "0:02:13", "3 d 04:05": a duration for people.
std::string duration_text(double seconds);

}  // namespace koshi
