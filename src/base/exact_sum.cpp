#include "base/exact_sum.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

namespace koshi {
namespace {

__extension__ using Wide = unsigned __int128;

}  // namespace

void ExactSum::add(double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const int exponent = static_cast<int>(bits >> 52 & 0x7ff);
  if (exponent == 0x7ff) {
    ++special_;
    return;
  }
  // The value is mantissa * 2^(e - 1074) with e = max(exponent, 1) - 1.
  std::uint64_t mantissa = bits & 0xfffffffffffffULL;
  if (exponent != 0) mantissa |= 1ULL << 52;
  const int e = exponent == 0 ? 0 : exponent - 1;

  // Spread the mantissa over two or three chunks of 32 bits each.
  const int k = e >> 5;
  const int shift = e & 31;
  const std::uint64_t low = (mantissa << shift) & 0xffffffffULL;
  const std::uint64_t rest = mantissa >> (32 - shift);
  const auto middle = static_cast<std::int64_t>(rest & 0xffffffffULL);
  const auto high = static_cast<std::int64_t>(rest >> 32);
  if (bits >> 63) {
    chunk_[k] -= static_cast<std::int64_t>(low);
    chunk_[k + 1] -= middle;
    chunk_[k + 2] -= high;
  } else {
    chunk_[k] += static_cast<std::int64_t>(low);
    chunk_[k + 1] += middle;
    chunk_[k + 2] += high;
  }
  if (++terms_ == std::int64_t{1} << 29) carry();
}

void ExactSum::carry() {
  for (int k = 0; k + 1 < chunk_count; ++k) {
    const std::int64_t over = chunk_[k] >> 32;  // floor division, so the rest lies in [0, 2^32)
    chunk_[k] -= over * (std::int64_t{1} << 32);
    chunk_[k + 1] += over;
  }
  terms_ = 0;
}

void ExactSum::sum_ranks(const Communicator& communicator) { koshi::sum_ranks({this, 1}, communicator); }

void sum_ranks(std::span<ExactSum> sums, const Communicator& communicator) {
  constexpr std::size_t numbers = ExactSum::chunk_count + 1;
  std::vector<std::int64_t> values(sums.size() * numbers);
  for (std::size_t s = 0; s < sums.size(); ++s) {
    sums[s].carry();
    std::copy(sums[s].chunk_.begin(), sums[s].chunk_.end(), &values[s * numbers]);
    values[s * numbers + ExactSum::chunk_count] = sums[s].special_;
  }
  communicator.sum(values);
  for (std::size_t s = 0; s < sums.size(); ++s) {
    std::copy_n(&values[s * numbers], ExactSum::chunk_count, sums[s].chunk_.begin());
    sums[s].special_ = values[s * numbers + ExactSum::chunk_count];
    sums[s].carry();
  }
}

double ExactSum::value() const {
  if (special_ != 0) return std::numeric_limits<double>::quiet_NaN();
  // Work on the magnitude, so that the leading chunks do not cancel.
  ExactSum sum = *this;
  sum.carry();
  const bool negative = sum.chunk_[chunk_count - 1] < 0;
  if (negative) {
    for (auto& c : sum.chunk_) c = -c;
    sum.carry();
  }
  // The three leading non-zero chunks hold at least 65 bits; what lies below only breaks ties and is kept as a sticky
  // bit.
  int top = chunk_count - 1;
  while (top > 0 && sum.chunk_[top] == 0) --top;
  Wide leading = 0;
  for (int k = top; k > top - 3; --k) leading = leading << 32 | static_cast<std::uint64_t>(k >= 0 ? sum.chunk_[k] : 0);
  bool sticky = false;
  for (int k = top - 3; k >= 0; --k) sticky = sticky || sum.chunk_[k] != 0;

  // Round to 64 bits with the sticky bit, then once to 53 bits through long double's 64-bit mantissa.
  int exponent = 32 * (top - 2) - 1074;
  while (leading >> 64 != 0) {
    sticky = sticky || (leading & 1) != 0;
    leading >>= 1;
    ++exponent;
  }
  auto significand = static_cast<std::uint64_t>(leading);
  if (sticky) significand |= 1;
  // Subnormal results have fewer bits; ldexp of the exact 64-bit integer rounds once in either case.
  const long double magnitude = std::ldexp(static_cast<long double>(significand), exponent);
  return static_cast<double>(negative ? -magnitude : magnitude);
}

}  // namespace koshi
