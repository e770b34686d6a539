#include "driver/schedule.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace koshi::driver {
namespace {

// Without a duration a quasi-static run gives up after this many steps.
constexpr std::int64_t most_quasi_static_steps = 2'000'000;

double end_of_changes(const model::Definition& definition) {
  double end = 0;
  const auto include = [&](const model::History& history) {
    if (!history.empty()) end = std::max(end, history.back()[0]);
  };
  for (const auto& boundary : definition.boundaries) {
    end = std::max(end, boundary.ramp);
    include(boundary.history);
  }
  for (const auto& load : definition.loads) include(load.history);
  return end;
}

}  // namespace

void check_step_count(const model::Definition& definition, double step) {
  constexpr double most = 1e12;
  const model::AnalysisDefinition& analysis = definition.analysis;
  if (!analysis.duration || *analysis.duration <= most * step) return;
  const bool small_step = analysis.time_step || analysis.safety < 1e-3;
  const std::string key = !small_step ? "duration" : analysis.time_step ? "time_step" : "safety";
  const std::string remedy = analysis.type == model::AnalysisDefinition::Type::quasi_static
                                 ? "a quasi-static run may do without a duration"
                             : small_step ? fmt::format("use a larger {}, or a shorter duration", key)
                                          : std::string("use a shorter duration, or check the units");
  throw InputError(definition.places.find("analysis." + key),
                   fmt::format("a duration of {:.6g} s takes {:.3g} steps of {:.3g} s; at most {:.0e} can be made, {}",
                               *analysis.duration, *analysis.duration / step, step, most, remedy));
}

Schedule::Schedule(const model::Definition& definition, double step, bool keep_step)
    : quasi_static_(definition.analysis.type == model::AnalysisDefinition::Type::quasi_static),
      tolerance_(definition.analysis.tolerance),
      settled_(end_of_changes(definition)),
      dt_(step),
      every_(definition.output.every.value_or(0)),
      history_every_(definition.output.history_every.value_or(0)),
      last_step_(most_quasi_static_steps),
      check_interval_(quasi_static_ ? 50 : 1000) {
  if (definition.analysis.duration) {
    // A step count that misses a whole number only by rounding is that number.
    const double steps = *definition.analysis.duration / step;
    last_step_ = std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(steps - 1e-9 * steps)));
    // A step that fits stays what it is to the last bit, so that a longer run takes the same steps.
    const double whole = static_cast<double>(last_step_);
    if (!keep_step && std::abs(steps - whole) > 1e-9 * steps) dt_ = *definition.analysis.duration / whole;
    if (history_every_ == 0 && !quasi_static_) history_every_ = *definition.analysis.duration / 200;
  }
}

bool Schedule::passes(std::int64_t step, double interval) const {
  if (interval <= 0) return false;
  const double before = std::floor(static_cast<double>(step - 1) * dt_ / interval + 1e-9);
  return std::floor(static_cast<double>(step) * dt_ / interval + 1e-9) > before;
}

bool Schedule::is_history(std::int64_t step) const {
  if (history_every_ > 0) return passes(step, history_every_);
  // At checks; ever fewer of them in a long run, so that the rows stay some hundreds.
  if (!is_check(step)) return false;
  std::int64_t stride = 1;
  while (step / check_interval_ / stride > 200) stride *= 2;
  return step / check_interval_ % stride == 0;
}

bool Schedule::at_rest(const mechanics::Balance& balance, double time) const {
  if (time < settled_ || !(balance.unbalanced_ratio() < tolerance_)) return false;
  // Forces also vanish in passing, when the motion is fastest; at rest the kinetic energy is small as well.
  return balance.kinetic_energy <= tolerance_ * tolerance_ * balance.elastic_energy || balance.reference == 0;
}

double Schedule::fraction(std::int64_t step, const mechanics::Balance& balance) const {
  if (!quasi_static_) return static_cast<double>(step) / static_cast<double>(last_step_);
  const double ratio = balance.unbalanced_ratio();
  return ratio > 0 && ratio < 1 ? std::clamp(std::log(ratio) / std::log(tolerance_), 0.0, 1.0) : 0;
}

}  // namespace koshi::driver
