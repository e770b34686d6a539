// Values on nodes in one byte each, for products that need two digits of them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/exact_sum.h"
#include "koshi/communicator.h"
#include "statics/row_field.h"

namespace koshi::statics {

/// Each component of a row of nodes in units of 1/127 of its largest value.
class ByteField {
 public:
  /// `value(c, i, j, k)` of the owned nodes.
  template <class Value>
  ByteField(const Int3& owned, int components, Value&& value) : owned_(owned), components_(components) {
    std::vector<float> row(static_cast<std::size_t>(owned[0]));
    units_.reserve(static_cast<std::size_t>(components * owned[1] * owned[2]));
    bytes_.reserve(units_.capacity() * row.size());
    for_each_row([&](int c, std::int64_t j, std::int64_t k) {
      float most = 0;
      for (std::size_t i = 0; i < row.size(); ++i) {
        row[i] = static_cast<float>(value(c, static_cast<std::int64_t>(i), j, k));
        most = std::max(most, std::abs(row[i]));
      }
      units_.push_back(most / 127);
      const float scale = most > 0 ? 127 / most : 0;
      for (const float entry : row) bytes_.push_back(static_cast<std::int8_t>(std::lround(scale * entry)));
    });
  }

  /// Sum of the products with values of a level (collective).
  double product(const RowField<float>& field, const Communicator& communicator) const {
    ExactSum sum;
    std::size_t row = 0;
    for_each_row([&](int c, std::int64_t j, std::int64_t k) {
      const std::int8_t* const own = bytes_.data() + row * static_cast<std::size_t>(owned_[0]);
      const float* const other = field.row(j, k) + c * field.pitch();
      double of_row = 0;
      for (std::int64_t i = 0; i < owned_[0]; ++i)
        of_row += static_cast<double>(own[i]) * static_cast<double>(other[i]);
      sum += static_cast<double>(units_[row++]) * of_row;
    });
    sum.sum_ranks(communicator);
    return sum.value();
  }

 private:
  template <class F>
  void for_each_row(F&& use) const {
    for (std::int64_t k = 0; k < owned_[2]; ++k)
      for (std::int64_t j = 0; j < owned_[1]; ++j)
        for (int c = 0; c < components_; ++c) use(c, j, k);
  }

  Int3 owned_;
  int components_;
  std::vector<std::int8_t> bytes_;
  std::vector<float> units_;  ///< by row and component
};

}  // namespace koshi::statics
