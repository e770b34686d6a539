// The objects of a checkpoint's HDF5 part, for its writer.
#pragma once

#include <hdf5.h>

#include <array>

#include "io/hdf5_handle.h"
#include "koshi/grid.h"

namespace koshi::io {

// Attributes of the root group, and its strings.
inline constexpr const char* time_name = "time";
inline constexpr const char* step_name = "step";
inline constexpr const char* version_name = "koshi_version";
inline constexpr const char* case_name = "case";
inline constexpr const char* blob_name = "blob";
inline constexpr const char* index_name = "index";
// Groups: scalars as attributes of the one, fields as datasets (components, nz, ny, nx) of the other.
inline constexpr const char* scalars_name = "scalars";
inline constexpr const char* fields_name = "fields";

/// Shape of a field's dataset.
inline std::array<hsize_t, 4> field_shape(int components, const Int3& nodes) {
  return {static_cast<hsize_t>(components), static_cast<hsize_t>(nodes[2]), static_cast<hsize_t>(nodes[1]),
          static_cast<hsize_t>(nodes[0])};
}

/// The owned nodes of one component in memory, without ghosts and padding: a selection of the rows of the layout.
inline hdf5::Handle memory_space(const lattice::Layout& layout) {
  const Int3& owned = layout.owned();
  const std::array<hsize_t, 3> shape{static_cast<hsize_t>(owned[2] + 2), static_cast<hsize_t>(owned[1] + 2),
                                     static_cast<hsize_t>(layout.pitch())};
  const std::array<hsize_t, 3> start{1, 1, static_cast<hsize_t>(lattice::Layout::lead)};
  const std::array<hsize_t, 3> count{static_cast<hsize_t>(owned[2]), static_cast<hsize_t>(owned[1]),
                                     static_cast<hsize_t>(owned[0])};
  hdf5::Handle space(H5Screate_simple(3, shape.data(), nullptr), H5Sclose, "describe memory");
  hdf5::check(H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr), "select nodes");
  return space;
}

/// Selects component c of this rank's owned nodes in the space of a field's dataset.
inline void select_owned(hid_t space, const lattice::Layout& layout, int c) {
  const Int3 &begin = layout.begin(), &owned = layout.owned();
  const std::array<hsize_t, 4> start{static_cast<hsize_t>(c), static_cast<hsize_t>(begin[2]),
                                     static_cast<hsize_t>(begin[1]), static_cast<hsize_t>(begin[0])};
  const std::array<hsize_t, 4> count{1, static_cast<hsize_t>(owned[2]), static_cast<hsize_t>(owned[1]),
                                     static_cast<hsize_t>(owned[0])};
  hdf5::check(H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr), "select nodes");
}

}  // namespace koshi::io
