#include <algorithm>

#include "koshi/model.h"

namespace koshi::model {

double factor(const History& history, double t) {
  if (history.empty()) return 1;
  const auto after =
      std::upper_bound(history.begin(), history.end(), t, [](double x, const auto& row) { return x < row[0]; });
  if (after == history.begin()) return history.front()[1];
  if (after == history.end()) return history.back()[1];
  const auto& [t0, f0] = *(after - 1);
  const auto& [t1, f1] = *after;
  return f0 + (f1 - f0) * (t - t0) / (t1 - t0);
}

double factor(const BoundaryDefinition& boundary, double t) {
  const double ramp = boundary.ramp > 0 ? std::clamp(t / boundary.ramp, 0.0, 1.0) : 1.0;
  return ramp * factor(boundary.history, t);
}

}  // namespace koshi::model
