// Fields of a simulation as NumPy arrays.
#pragma once

#include <pybind11/numpy.h>

#include "koshi/field.h"

namespace koshi::python {

/// Shape, strides and start of a box of a field for NumPy: (components, nz, ny, nx).
template <class T>
pybind11::array view_of(lattice::Field<T>& field, const lattice::Layout& layout, int components, const Int3& box,
                        const pybind11::handle& owner, bool writeable) {
  constexpr auto bytes = static_cast<pybind11::ssize_t>(sizeof(T));
  pybind11::array view(
      pybind11::dtype::of<T>(), std::vector<pybind11::ssize_t>{components, box[2], box[1], box[0]},
      std::vector<pybind11::ssize_t>{bytes * field.stride(), bytes * layout.plane(), bytes * layout.pitch(), bytes},
      field.component(0) + layout.index(0, 0, 0), owner);
  if (!writeable) view.attr("flags").attr("writeable") = false;
  return view;
}

/// The cells whose lowest corner this rank owns.
Int3 owned_cells(const lattice::Grid& grid, const lattice::Layout& layout);

/// Positions [m] of this rank's planes of nodes across x, y, z.
pybind11::tuple coordinates(const lattice::Grid& grid, const lattice::Layout& layout);

}  // namespace koshi::python
