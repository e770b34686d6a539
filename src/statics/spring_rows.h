// The springs of a multigrid level, cell by cell.
#pragma once

#include <cstdint>
#include <vector>

#include "mechanics/cell_strip.h"
#include "statics/row_field.h"

namespace koshi::statics {

/// Rows of cells, each distinct one stored once: a body has few unless its materials are finely mixed. A cell is two
/// bytes, the number of its kind, as long as the level has at most 65535 kinds of cells: of two phases and merged
/// levels there are a few hundred. Beyond that it is its seven constants. Cells are known by their lowest corner, from
/// -1 to owned - 1 in each direction.
class SpringRows {
 public:
  /// `constants`: a cell's constants at its lowest corner, ghosts included; their memory is free when the rows are
  /// made. `tied`: whether the cells tie strain to other motions (mechanics/strain_tie.h).
  explicit SpringRows(RowField<float> constants, bool tied = true);

  /// Number of the row; rows with the same number are equal.
  std::int32_t row(std::int64_t j, std::int64_t k) const {
    return rows_[static_cast<std::size_t>(j + 1 + (owned_[1] + 1) * (k + 1))];
  }
  /// Constant q of cell i of a row; zero from cell `owned` on.
  float constant(std::int32_t row, std::int64_t i, int q) const {
    const auto r = static_cast<std::size_t>(row);
    return table_.empty() ? of_constants_[r][lead + q * pitch_ + i]
                          : table_[static_cast<std::size_t>(mechanics::table_constants * of_kinds_[r][lead + i] + q)];
  }
  /// Prepared constants (mechanics/cell_strip.h) of cells i, i + 1, ... of a row.
  void prepare(std::int32_t row, std::int64_t i, std::int64_t cells, float* to) const;
  /// Cells first <= i < last of a row hold all that are not empty; first = last: the row is empty.
  struct Span {
    std::int32_t first, last;
  };
  Span span(std::int32_t row) const { return spans_[static_cast<std::size_t>(row)]; }
  const Int3& owned() const { return owned_; }
  bool tied() const { return tied_; }

 private:
  static constexpr std::int64_t lead = 16;
  using Kind = std::uint16_t;
  template <class T>
  using Pool = std::vector<AlignedArray<T>>;
  /// Calls make(j, k, row) for all rows, each `size` elements that are zero, and keeps those that are distinct; stops
  /// where that gives false.
  template <class T, class Make>
  bool collect(Pool<T>& pool, std::int64_t size, Make&& make);
  bool collect_kinds(const RowField<float>& constants);
  Span make_span(std::int32_t row) const;

  Int3 owned_;
  bool tied_;
  std::ptrdiff_t pitch_;
  std::vector<std::int32_t> rows_;
  std::vector<float> table_;  ///< constants of each kind, that of empty cells first; empty: rows are constants
  Pool<Kind> of_kinds_;
  Pool<float> of_constants_;
  std::vector<Span> spans_;
};

}  // namespace koshi::statics
