// How solids hang together in a body given cell by cell.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "koshi/vector3.h"

namespace koshi::io {

/// Along how many axes each solid leads through the box, from cell to cell by faces: 0 to 3. `solid` has one value a
/// cell, x fastest, 0 is void.
std::map<std::uint16_t, int> directions_through(const std::vector<std::uint16_t>& solid, const Int3& cells);

}  // namespace koshi::io
