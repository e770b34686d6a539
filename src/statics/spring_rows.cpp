#include "statics/spring_rows.h"

#include <algorithm>
#include <string>
#include <unordered_map>

namespace koshi::statics {

// A row holds one vector before cell 0 and two beyond the last one, for the kernels.
SpringRows::SpringRows(const RowField<float>& constants)
    : owned_(constants.owned()),
      pitch_((owned_[0] + 3 * lead + lead - 1) / lead * lead),
      row_size_(pitch_ * mechanics::cell_constants) {
  const auto cells = static_cast<std::size_t>(owned_[0] + 1);  // -1 ... owned - 1
  std::unordered_map<std::string, std::int32_t> known;
  std::string key;
  for (std::int64_t k = -1; k < owned_[2]; ++k)
    for (std::int64_t j = -1; j < owned_[1]; ++j) {
      key.clear();
      for (int q = 0; q < mechanics::cell_constants; ++q)
        key.append(reinterpret_cast<const char*>(constants.row(j, k) + q * constants.pitch() - 1),
                   cells * sizeof(float));
      const auto [entry, is_new] = known.try_emplace(key, static_cast<std::int32_t>(spans_.size()));
      rows_.push_back(entry->second);
      if (!is_new) continue;

      pool_.resize(pool_.size() + static_cast<std::size_t>(row_size_));
      float* const to = pool_.data() + lead + entry->second * row_size_;
      Span span{static_cast<std::int32_t>(owned_[0]), -1};
      for (int q = 0; q < mechanics::cell_constants; ++q)
        for (std::int64_t i = -1; i < owned_[0]; ++i) {
          const float value = constants.row(j, k)[q * constants.pitch() + i];
          to[q * pitch_ + i] = value;
          if (value == 0) continue;
          span.first = std::min(span.first, static_cast<std::int32_t>(i));
          span.last = std::max(span.last, static_cast<std::int32_t>(i + 1));
        }
      spans_.push_back(span.first < span.last ? span : Span{0, 0});
    }
}

}  // namespace koshi::statics
