#include "statics/spring_rows.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <string_view>
#include <unordered_map>

namespace koshi::statics {
namespace {

using mechanics::cell_constants;
using Constants = std::array<float, cell_constants>;

template <class T>
std::string_view bytes_of(const T* values, std::int64_t count) {
  return {reinterpret_cast<const char*>(values), static_cast<std::size_t>(count) * sizeof(T)};
}

struct Hash {
  std::size_t operator()(const Constants& k) const {
    return std::hash<std::string_view>{}(bytes_of(k.data(), cell_constants));
  }
};

Constants constants_at(const RowField<float>& constants, std::int64_t i, std::int64_t j, std::int64_t k) {
  Constants values;
  for (int q = 0; q < cell_constants; ++q)
    values[static_cast<std::size_t>(q)] = constants.row(j, k)[q * constants.pitch() + i];
  return values;
}

}  // namespace

// A row holds one vector before cell 0 and two beyond the last one, for the kernels.
SpringRows::SpringRows(RowField<float> constants, bool tied)
    : owned_(constants.owned()), tied_(tied), pitch_((owned_[0] + 3 * lead + lead - 1) / lead * lead) {
  if (!collect_kinds(constants)) {
    of_kinds_.clear();
    collect(of_constants_, pitch_ * cell_constants, [&](std::int64_t j, std::int64_t k, float* row) {
      for (int q = 0; q < cell_constants; ++q)
        std::copy_n(constants.row(j, k) + q * constants.pitch() - 1, owned_[0] + 1, row + lead + q * pitch_ - 1);
      return true;
    });
  }
  const std::size_t count = std::max(of_kinds_.size(), of_constants_.size());
  for (std::size_t row = 0; row < count; ++row) spans_.push_back(make_span(static_cast<std::int32_t>(row)));
}

template <class T, class Make>
bool SpringRows::collect(Pool<T>& pool, std::int64_t size, Make&& make) {
  // Known rows by their bytes, which stay where they are while the pool grows.
  std::unordered_map<std::string_view, std::int32_t> known;
  rows_.clear();
  AlignedArray<T> made;
  for (std::int64_t k = -1; k < owned_[2]; ++k)
    for (std::int64_t j = -1; j < owned_[1]; ++j) {
      if (!made) made = aligned_array<T>(size);
      std::fill_n(made.get(), size, T{});
      if (!make(j, k, made.get())) return false;
      const auto next = static_cast<std::int32_t>(pool.size());
      const auto [entry, is_new] = known.try_emplace(bytes_of(made.get(), size), next);
      rows_.push_back(entry->second);
      if (is_new) pool.push_back(std::move(made));
    }
  return true;
}

bool SpringRows::collect_kinds(const RowField<float>& constants) {
  constexpr std::size_t most = std::numeric_limits<Kind>::max();
  std::unordered_map<Constants, Kind, Hash> kinds;
  kinds[{}] = 0;
  // Neighbours are often alike.
  Constants last{};
  Kind last_kind = 0;
  const bool few = collect(of_kinds_, pitch_, [&](std::int64_t j, std::int64_t k, Kind* row) {
    for (std::int64_t i = -1; i < owned_[0]; ++i) {
      const Constants here = constants_at(constants, i, j, k);
      if (here != last) {
        if (kinds.size() > most) return false;
        last_kind = kinds.try_emplace(here, static_cast<Kind>(kinds.size())).first->second;
        last = here;
      }
      row[lead + i] = last_kind;
    }
    return true;
  });
  if (!few) return false;
  // The kernel reads whole vectors.
  table_.assign((kinds.size() + 1) * mechanics::table_constants, 0.0f);
  for (const auto& [values, kind] : kinds)
    std::copy(values.begin(), values.end(), table_.begin() + std::ptrdiff_t{kind} * mechanics::table_constants);
  return true;
}

void SpringRows::prepare(std::int32_t row, std::int64_t i, std::int64_t cells, float* to) const {
  const auto& kernels = mechanics::strip_kernels<float>();
  const auto r = static_cast<std::size_t>(row);
  if (table_.empty())
    kernels.prepare_rows(of_constants_[r].get() + lead + i, pitch_, tied_ ? 1 : 0, cells, to);
  else
    kernels.prepare(of_kinds_[r].get() + lead + i, nullptr, table_.data(), tied_ ? 1 : 0, cells, to);
}

SpringRows::Span SpringRows::make_span(std::int32_t row) const {
  Span span{static_cast<std::int32_t>(owned_[0]), -1};
  for (std::int64_t i = -1; i < owned_[0]; ++i) {
    bool empty = true;
    for (int q = 0; q < cell_constants; ++q) empty = empty && constant(row, i, q) == 0;
    if (empty) continue;
    span.first = std::min(span.first, static_cast<std::int32_t>(i));
    span.last = std::max(span.last, static_cast<std::int32_t>(i + 1));
  }
  return span.first < span.last ? span : Span{0, 0};
}

}  // namespace koshi::statics
