// A sum that compilers turn into vector instructions and that still has one order.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace koshi {

/// Sum of term(i) for 0 <= i < count, in so many partial sums side by side; the order depends on the count alone.
template <std::int64_t lanes, class Term>
double lane_sum(std::int64_t count, Term&& term) {
  std::array<double, lanes> sum{};
  std::int64_t i = 0;
  for (; i + lanes <= count; i += lanes)
    for (std::int64_t l = 0; l < lanes; ++l) sum[static_cast<std::size_t>(l)] += term(i + l);
  for (std::int64_t l = 0; i < count; ++i, ++l) sum[static_cast<std::size_t>(l)] += term(i);
  double total = 0;
  for (const double s : sum) total += s;
  return total;
}

}  // namespace koshi
