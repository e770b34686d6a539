// The cells of the box, one by one.
#pragma once

#include <algorithm>

#include "koshi/model.h"

namespace koshi::homogenize {

/// Calls f(index) for each cell of the box, void or not, on the rank that owns its lowest corner. The last layer of
/// nodes of a body that is not periodic is the lowest corner of none.
template <class F>
void for_each_cell(const model::Model& model, F&& f) {
  const lattice::Layout& layout = model.layout();
  Int3 end = layout.owned();
  for (std::size_t a = 0; a < 3; ++a) end[a] = std::min(end[a], model.lattice.grid.cells[a] - layout.begin()[a]);
  lattice::for_each(layout, {0, 0, 0}, end, [&](auto, auto, auto, auto n) { f(n); });
}

}  // namespace koshi::homogenize
