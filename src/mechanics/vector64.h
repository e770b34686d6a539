// Vectors of 64 bytes for the kernels that are compiled once per instruction set; include nowhere else.
#pragma once

#include <cstdint>

#define KOSHI_INLINE inline __attribute__((always_inline))

namespace koshi::mechanics::KOSHI_ISA {

template <class T>
struct Vector;
template <>
struct Vector<float> {
  typedef float type __attribute__((vector_size(64)));
};
template <>
struct Vector<double> {
  typedef double type __attribute__((vector_size(64)));
};

/// Elements of a vector.
template <class T>
constexpr std::int64_t width = 64 / static_cast<std::int64_t>(sizeof(T));

template <class T>
KOSHI_INLINE typename Vector<T>::type load(const T* p) {
  typename Vector<T>::type v;
  __builtin_memcpy(&v, p, sizeof v);
  return v;
}

template <class T>
KOSHI_INLINE void store(T* p, const typename Vector<T>::type& v) {
  __builtin_memcpy(p, &v, sizeof v);
}

}  // namespace koshi::mechanics::KOSHI_ISA
