#include "mechanics/percentile.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <tuple>

namespace koshi::mechanics {

double percentile(const Communicator& communicator, const std::vector<Weighted>& values, double percent) {
  std::string bytes(values.size() * sizeof(Weighted), '\0');
  if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  bytes = communicator.all_gather(bytes);
  std::vector<Weighted> all(bytes.size() / sizeof(Weighted));
  if (all.empty()) return 0;
  std::memcpy(all.data(), bytes.data(), bytes.size());

  // One order whatever the ranks, so that the sums are the same too.
  const auto order = [](const Weighted& v) { return std::tuple(std::abs(v.value), v.value, v.weight); };
  std::sort(all.begin(), all.end(), [&](const Weighted& a, const Weighted& b) { return order(a) < order(b); });
  double total = 0, below = 0;
  for (const Weighted& v : all) total += v.weight;
  const double part = percent / 100 * total * (1 - 1e-12);
  for (const Weighted& v : all) {
    below += v.weight;
    if (below >= part) return v.value;
  }
  return all.back().value;
}

}  // namespace koshi::mechanics
