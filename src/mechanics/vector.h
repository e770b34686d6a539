// Vectors as wide as the instruction set's, for the kernels that are compiled once per instruction set; include nowhere
// else.
#pragma once

#include <cstdint>
#include <utility>

#define KOSHI_INLINE inline __attribute__((always_inline))

namespace koshi::mechanics::KOSHI_ISA {

#if defined(__AVX512F__)
inline constexpr std::int64_t vector_bytes = 64;
#elif defined(__AVX2__)
inline constexpr std::int64_t vector_bytes = 32;
#else
inline constexpr std::int64_t vector_bytes = 16;
#endif

template <class T>
struct Vector;
template <>
struct Vector<float> {
  typedef float type __attribute__((vector_size(vector_bytes)));
};
template <>
struct Vector<double> {
  typedef double type __attribute__((vector_size(vector_bytes)));
};

/// Elements of a vector.
template <class T>
inline constexpr std::int64_t width = vector_bytes / static_cast<std::int64_t>(sizeof(T));

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

/// Floats as elements of type T.
template <class T>
KOSHI_INLINE typename Vector<T>::type widened(const float* p) {
  typedef float Floats __attribute__((vector_size(width<T> * sizeof(float))));
  Floats v;
  __builtin_memcpy(&v, p, sizeof v);
  return __builtin_convertvector(v, typename Vector<T>::type);
}

/// Integers as floats.
KOSHI_INLINE Vector<float>::type widened_integers(const std::int16_t* p) {
  typedef std::int16_t Integers __attribute__((vector_size(width<float> * sizeof(std::int16_t))));
  Integers v;
  __builtin_memcpy(&v, p, sizeof v);
  return __builtin_convertvector(v, Vector<float>::type);
}

/// `value` in the last element, zero in the others.
template <class T>
KOSHI_INLINE typename Vector<T>::type last_lane(T value) {
  typename Vector<T>::type v{};
  v[width<T> - 1] = value;
  return v;
}

template <class T, std::size_t... lane>
KOSHI_INLINE typename Vector<T>::type shifted(const typename Vector<T>::type& before, const typename Vector<T>::type& v,
                                              std::index_sequence<lane...>) {
  return __builtin_shufflevector(before, v, static_cast<int>(width<T> - 1 + lane)...);
}
/// The last element of `before`, then all but the last of `v`.
template <class T>
KOSHI_INLINE typename Vector<T>::type shifted(const typename Vector<T>::type& before,
                                              const typename Vector<T>::type& v) {
  return shifted<T>(before, v, std::make_index_sequence<width<T>>{});
}

template <class T, std::size_t step, std::size_t... lane>
KOSHI_INLINE void transpose_step(typename Vector<T>::type* v, std::index_sequence<lane...>) {
  for (std::size_t i = 0; i < width<T>; ++i) {
    if ((i & step) != 0) continue;
    const auto a = v[i], b = v[i + step];
    v[i] = __builtin_shufflevector(a, b, static_cast<int>((lane & step) != 0 ? width<T> + lane - step : lane)...);
    v[i + step] =
        __builtin_shufflevector(a, b, static_cast<int>((lane & step) != 0 ? width<T> + lane : lane + step)...);
  }
}
/// Element j of vector i and element i of vector j of `width` vectors change places.
template <class T, std::size_t step = 1>
KOSHI_INLINE void transpose(typename Vector<T>::type* v) {
  if constexpr (step < width<T>) {
    transpose_step<T, step>(v, std::make_index_sequence<width<T>>{});
    transpose<T, 2 * step>(v);
  }
}

}  // namespace koshi::mechanics::KOSHI_ISA
