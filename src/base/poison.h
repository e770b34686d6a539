// Memory that is written whole before it is read. A debug build fills it with NaN first: what is read unwritten shows
// in the result.
#pragma once

#include <cstddef>
#include <cstring>

namespace koshi {

#ifdef NDEBUG
inline constexpr bool poisons = false;
#else
inline constexpr bool poisons = true;
#endif

/// Fills floating-point numbers with NaN in a debug build: all bits set, which is one in every precision.
inline void poison(void* memory, std::size_t bytes) {
  if constexpr (poisons) std::memset(memory, 0xff, bytes);
}

}  // namespace koshi
