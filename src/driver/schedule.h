// When an explicit run samples, checks and ends. Everything follows from the step number alone, so a restarted run
// keeps the rhythm of an uninterrupted one.
#pragma once

#include <cstdint>

#include "koshi/definition.h"
#include "mechanics/measure.h"

namespace koshi::driver {

/// Throws an InputError where the duration takes more steps of `step` seconds than a run can make: beyond a million
/// million, which is far below what a clock of 53 bits still tells apart.
void check_step_count(const model::Definition& definition, double step);

class Schedule {
 public:
  /// `step`: the largest step to use [s]; unless it fits it is shortened a little so that the run ends exactly on its
  /// duration. With `keep_step` it is used as it is, and the run ends with the first step that reaches its duration.
  Schedule(const model::Definition& definition, double step, bool keep_step = false);

  double dt() const { return dt_; }
  std::int64_t last_step() const { return last_step_; }
  bool samples_fields() const { return every_ > 0; }
  bool is_field(std::int64_t step) const { return passes(step, every_); }
  bool is_history(std::int64_t step) const;
  /// Steps at which balance and divergence are looked at.
  bool is_check(std::int64_t step) const { return step % check_interval_ == 0; }
  bool is_poll(std::int64_t step) const { return step % 10 == 0; }

  /// Quasi-static rest: nothing prescribed changes any more, and both the unbalanced forces and the motion are small.
  bool at_rest(const mechanics::Balance& balance, double time) const;
  /// Part of the run that is done.
  double fraction(std::int64_t step, const mechanics::Balance& balance) const;

 private:
  /// Whether the step is the first at or after a multiple of `interval` [s].
  bool passes(std::int64_t step, double interval) const;

  bool quasi_static_;
  double tolerance_;
  double settled_;  ///< [s], when ramps and histories have ended
  double dt_;
  double every_, history_every_;  ///< [s], 0: not by time
  std::int64_t last_step_, check_interval_;
};

}  // namespace koshi::driver
