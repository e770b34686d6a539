// The corners of a cell.
#pragma once

#include <array>

namespace koshi::mechanics {

inline constexpr int corner_count = 8;

/// Corner a = x + 2 y + 4 z of a cell, as its coordinates in cells: each 0 or 1.
constexpr std::array<int, 3> corner(int a) { return {a & 1, a >> 1 & 1, a >> 2 & 1}; }

}  // namespace koshi::mechanics
