// A sum of doubles without rounding, hence independent of the order of its terms and of the number of ranks.
// Fixed-point accumulator over the whole exponent range: the small superaccumulator of R. M. Neal, arXiv:1505.05571.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "koshi/communicator.h"

namespace koshi {

class ExactSum {
 public:
  void add(double x);
  ExactSum& operator+=(double x) {
    add(x);
    return *this;
  }
  /// Adds what the other ranks hold (collective); afterwards all ranks hold the whole sum.
  void sum_ranks(const Communicator& communicator);
  /// The sum, rounded once. NaN if a term was infinite or not a number.
  double value() const;

 private:
  friend void sum_ranks(std::span<ExactSum> sums, const Communicator& communicator);
  void carry();

  // Chunk k holds multiples of 2^(32 k - 1074); 64-bit chunks overlap by 32 bits, so 2^29 terms fit before carrying.
  static constexpr int chunk_count = 67;
  std::array<std::int64_t, chunk_count> chunk_{};
  std::int64_t terms_ = 0;
  std::int64_t special_ = 0;  // terms that were no finite numbers
};

/// The same for many sums at once (collective; as many on every rank).
void sum_ranks(std::span<ExactSum> sums, const Communicator& communicator);

}  // namespace koshi
