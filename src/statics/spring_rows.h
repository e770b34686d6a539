// The springs of a multigrid level, cell by cell.
#pragma once

#include <cstdint>
#include <vector>

#include "mechanics/cell_strip.h"
#include "statics/row_field.h"

namespace koshi::statics {

/// Rows of cells, each distinct one stored once: a body has few unless its materials are finely mixed. Cells are known
/// by their lowest corner, from -1 to owned - 1 in each direction.
class SpringRows {
 public:
  /// `constants`: a cell's constants at its lowest corner, ghosts included.
  explicit SpringRows(const RowField<float>& constants);

  /// Number of the row; rows with the same number are equal.
  std::int32_t row(std::int64_t j, std::int64_t k) const {
    return rows_[static_cast<std::size_t>(j + 1 + (owned_[1] + 1) * (k + 1))];
  }
  /// Constant 0 of cell i = 0 of a row; zero from cell `owned` on.
  const float* constants(std::int32_t row) const { return pool_[static_cast<std::size_t>(row)].get() + lead; }
  std::ptrdiff_t pitch() const { return pitch_; }
  /// Cells first <= i < last of a row hold all that are not empty; first = last: the row is empty.
  struct Span {
    std::int32_t first, last;
  };
  Span span(std::int32_t row) const { return spans_[static_cast<std::size_t>(row)]; }
  const Int3& owned() const { return owned_; }

 private:
  static constexpr std::int64_t lead = 16;
  using Row = AlignedArray<float>;
  Row make_row(const RowField<float>& constants, std::int64_t j, std::int64_t k) const;
  Span make_span(const float* row) const;

  Int3 owned_;
  std::ptrdiff_t pitch_, row_size_;
  std::vector<std::int32_t> rows_;
  std::vector<Row> pool_;
  std::vector<Span> spans_;
};

}  // namespace koshi::statics
