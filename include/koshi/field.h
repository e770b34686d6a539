// Values on the nodes of one rank, structure of arrays.
#pragma once

#include <cstddef>
#include <cstring>
#include <memory>
#include <span>

#include "koshi/grid.h"

namespace koshi::lattice {

/// Memory for the values of a field, 64-byte aligned and in huge pages where it fills them; throws std::bad_alloc.
void* allocate_values(std::size_t bytes);
/// Gives back what allocate_values() returned; nothing for a null pointer.
void free_values(void* values);

/// `components` values of type T per node, component c of node n at component(c)[n] with n = Layout::index. One block
/// of 64-byte aligned memory, zero at first; the same memory serves kernels, files and NumPy views.
template <class T>
class Field {
 public:
  Field() = default;
  /// Zero on all nodes of the layout, ghosts and padding included.
  Field(const Layout& layout, int components)
      : components_(components),
        stride_(padded(layout.size())),
        data_(allocate(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(components))) {
    zero();
  }
  /// Deep.
  Field(const Field& other) : components_(other.components_), stride_(other.stride_), data_(allocate(other.count())) {
    if (other.count() != 0) std::memcpy(data_.get(), other.data_.get(), count() * sizeof(T));
  }
  Field(Field&&) noexcept = default;  ///< leaves the other empty
  /// Deep.
  Field& operator=(const Field& other) {
    if (this != &other) *this = Field(other);
    return *this;
  }
  Field& operator=(Field&&) noexcept = default;  ///< leaves the other empty

  int components() const { return components_; }                         ///< values per node
  T* component(int c) { return data_.get() + c * stride_; }              ///< c in [0, components)
  const T* component(int c) const { return data_.get() + c * stride_; }  ///< c in [0, components)
  /// Elements from one component to the next.
  std::int64_t stride() const { return stride_; }
  /// All elements, padding included.
  std::size_t count() const { return static_cast<std::size_t>(stride_) * static_cast<std::size_t>(components_); }
  T* data() { return data_.get(); }              ///< all elements
  const T* data() const { return data_.get(); }  ///< all elements
  /// Sets every element to zero.
  void zero() {
    if (count() != 0) std::memset(static_cast<void*>(data_.get()), 0, count() * sizeof(T));
  }

 private:
  static constexpr std::size_t alignment = 64;
  struct Free {
    void operator()(T* p) const { free_values(p); }
  };
  // Components are kept apart by an odd number of cache lines, so that they do not compete for the same cache sets.
  static std::int64_t padded(std::int64_t size) {
    const std::int64_t line = static_cast<std::int64_t>(alignment / sizeof(T));
    return ((size + line - 1) / line | 1) * line;
  }
  static T* allocate(std::size_t count) { return static_cast<T*>(allocate_values(count * sizeof(T))); }

  int components_ = 0;
  std::int64_t stride_ = 0;
  std::unique_ptr<T[], Free> data_;
};

}  // namespace koshi::lattice
