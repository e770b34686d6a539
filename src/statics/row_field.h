// Values on the nodes of a multigrid level.
#pragma once

#include <cstdint>
#include <cstring>
#include <memory>
#include <new>

#include "koshi/vector3.h"
#include "lattice/halo.h"

namespace koshi::statics {

/// Memory for vectors of 64 bytes, not initialised.
struct AlignedDelete {
  void operator()(void* p) const { ::operator delete[](p, std::align_val_t{64}); }
};
template <class T>
using AlignedArray = std::unique_ptr<T[], AlignedDelete>;
template <class T>
AlignedArray<T> aligned_array(std::int64_t size) {
  return AlignedArray<T>(new (std::align_val_t{64}) T[static_cast<std::size_t>(size)]);
}

/// Values of type T on a rank's nodes and one layer of ghosts, zero at first. The components of a row of nodes lie side
/// by side, `pitch` elements apart and aligned to 64 bytes: a sweep then runs through memory in few long streams.
template <class T>
class RowField {
 public:
  RowField() = default;
  RowField(const Int3& owned, int components)
      : owned_(owned),
        components_(components),
        pitch_((owned[0] + 2 + width - 1) / width * width),
        row_(pitch_ * components),
        plane_(row_ * (owned[1] + 2)),
        data_(aligned_array<T>(size())) {
    zero();
  }

  const Int3& owned() const { return owned_; }
  int components() const { return components_; }
  std::ptrdiff_t pitch() const { return pitch_; }
  /// Node i = 0 of row (j, k), component 0; -1 <= j <= owned y, -1 <= k <= owned z, -1 <= i <= owned x.
  T* row(std::int64_t j, std::int64_t k) { return data_.get() + width + row_ * (j + 1) + plane_ * (k + 1); }
  const T* row(std::int64_t j, std::int64_t k) const { return data_.get() + width + row_ * (j + 1) + plane_ * (k + 1); }
  /// Nodes i, i + 1, ... of row (j, k) are needed soon: fetches them into the second-level cache.
  void fetch(std::int64_t i, std::int64_t j, std::int64_t k, std::int64_t nodes) const {
    for (int c = 0; c < components_; ++c)
      for (std::int64_t n = i; n < i + nodes; n += width) __builtin_prefetch(row(j, k) + c * pitch_ + n, 0, 2);
  }
  void zero() { std::memset(data_.get(), 0, static_cast<std::size_t>(size()) * sizeof(T)); }

  /// Fills the ghosts (collective over the neighbours).
  void exchange(const lattice::Halo& halo) {
    if (!halo.active()) return;
    halo.begin(row(0, 0), components_, {pitch_, row_, plane_});
    halo.end();
  }

 private:
  static constexpr std::int64_t width = 64 / static_cast<std::int64_t>(sizeof(T));
  // Vectors may be read and written beyond the last row.
  std::int64_t size() const { return plane_ * (owned_[2] + 2) + 4 * width; }

  Int3 owned_{};
  int components_ = 0;
  std::ptrdiff_t pitch_ = 0, row_ = 0, plane_ = 0;
  AlignedArray<T> data_;
};

}  // namespace koshi::statics
