#include "statics/spring_rows.h"

#include <algorithm>
#include <string_view>
#include <unordered_map>

namespace koshi::statics {

// A row holds one vector before cell 0 and two beyond the last one, for the kernels.
SpringRows::SpringRows(const RowField<float>& constants)
    : owned_(constants.owned()),
      pitch_((owned_[0] + 3 * lead + lead - 1) / lead * lead),
      row_size_(pitch_ * mechanics::cell_constants) {
  // Known rows by their bytes, which stay where they are while the pool grows.
  std::unordered_map<std::string_view, std::int32_t> known;
  for (std::int64_t k = -1; k < owned_[2]; ++k)
    for (std::int64_t j = -1; j < owned_[1]; ++j) {
      Row made = make_row(constants, j, k);
      const std::string_view bytes(reinterpret_cast<const char*>(made.get()),
                                   static_cast<std::size_t>(row_size_) * sizeof(float));
      const auto [entry, is_new] = known.try_emplace(bytes, static_cast<std::int32_t>(pool_.size()));
      rows_.push_back(entry->second);
      if (!is_new) continue;
      spans_.push_back(make_span(made.get() + lead));
      pool_.push_back(std::move(made));
    }
}

SpringRows::Row SpringRows::make_row(const RowField<float>& constants, std::int64_t j, std::int64_t k) const {
  Row row = aligned_array<float>(row_size_);
  std::fill_n(row.get(), row_size_, 0.0f);
  for (int q = 0; q < mechanics::cell_constants; ++q)
    std::copy_n(constants.row(j, k) + q * constants.pitch() - 1, owned_[0] + 1, row.get() + lead + q * pitch_ - 1);
  return row;
}

SpringRows::Span SpringRows::make_span(const float* row) const {
  Span span{static_cast<std::int32_t>(owned_[0]), -1};
  for (int q = 0; q < mechanics::cell_constants; ++q)
    for (std::int64_t i = -1; i < owned_[0]; ++i) {
      if (row[q * pitch_ + i] == 0) continue;
      span.first = std::min(span.first, static_cast<std::int32_t>(i));
      span.last = std::max(span.last, static_cast<std::int32_t>(i + 1));
    }
  return span.first < span.last ? span : Span{0, 0};
}

}  // namespace koshi::statics
