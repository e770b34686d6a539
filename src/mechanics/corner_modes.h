// Modes of a cell's corners: products of the signs of some of their coordinates.
#pragma once

#include <bit>

namespace koshi::mechanics {

/// Of a corner (corner(), corners.h) in a mode, given as the bits of its axes: 1 or -1.
inline double mode_sign(int corner, int mode) {
  return std::popcount(static_cast<unsigned>(~corner & mode)) % 2 == 0 ? 1 : -1;
}

}  // namespace koshi::mechanics
