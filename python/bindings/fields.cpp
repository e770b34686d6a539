#include "fields.h"

namespace koshi::python {

namespace py = pybind11;

Int3 owned_cells(const lattice::Grid& grid, const lattice::Layout& layout) {
  Int3 cells;
  for (int a = 0; a < 3; ++a) cells[a] = std::min(layout.owned()[a], grid.cells[a] - layout.begin()[a]);
  return cells;
}

py::tuple coordinates(const lattice::Grid& grid, const lattice::Layout& layout) {
  py::tuple result(3);
  for (int a = 0; a < 3; ++a) {
    py::array_t<double> positions(layout.owned()[a]);
    for (std::int64_t i = 0; i < layout.owned()[a]; ++i) {
      Int3 node = layout.begin();
      node[a] += i;
      positions.mutable_at(i) = grid.position(node)[a];
    }
    result[static_cast<std::size_t>(a)] = positions;
  }
  return result;
}

}  // namespace koshi::python
