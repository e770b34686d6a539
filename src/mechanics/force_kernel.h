// Internal forces of the lattice, gathered row by row: every node sums over its own bonds and cells in a fixed order
// and writes only itself, so results do not depend on the partition among ranks.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "koshi/spring_lattice.h"
#include "mechanics/row_kernels.h"

namespace koshi::mechanics {

/// F = -K u for the springs of one lattice, in precision T. A node with the same material in its eight cells is served
/// by a stencil with constant coefficients, as is one in a flat face across x, where a row would end with a short
/// vector; the others by their bonds and cells one by one. The lattice must outlive it.
template <class T>
class ForceKernel {
 public:
  explicit ForceKernel(const model::SpringLattice& lattice);

  /// Forces [N] and moments [N m] of row (j, k), component by component, pointers to node i = 0; valid until the next
  /// call. Ghosts of `u` must be up to date.
  T* const* row(const lattice::Field<T>& u, std::int64_t j, std::int64_t k);

  /// force = -K u on all owned nodes; exchanges the ghosts of u on the way (collective).
  void apply(lattice::Field<T>& u, lattice::Field<T>& force);

  const model::SpringLattice& lattice() const { return lattice_; }
  int components() const { return components_; }

 private:
  enum class Kind : std::uint8_t {
    empty,       // no material around
    uniform,     // one material all around
    face_above,  // one node in a flat face across x, one material above it or below it
    face_below,
    bonds  // anything else
  };
  /// Nodes first <= i < last of a row.
  struct Segment {
    std::int32_t first, last;
    Kind kind;
    std::uint8_t material;
  };
  Kind kind_of(std::int64_t node) const;
  void make_tables();
  void make_segments();
  void poison_owned(lattice::Field<T>& force) const;
  void write_row(const lattice::Field<T>& u, std::int64_t j, std::int64_t k, lattice::Field<T>& force);

  const model::SpringLattice& lattice_;
  int components_;
  bool volumetric_;
  std::vector<Segment> segments_;
  std::vector<std::int64_t> row_segments_;            ///< first segment of each row, x fastest rows j + owned_y k
  std::vector<Stencil<T>> stencils_;                  ///< by material
  std::vector<std::array<FaceStencil<T>, 2>> faces_;  ///< by material, above and below
  std::vector<T> kt_, kb_, volumetric_table_, fit_table_;
  Tables<T> tables_{};
  lattice::Field<T> work_;  ///< one row per component
  Scratch<T> scratch_;
  std::array<T*, 6> force_;
};

}  // namespace koshi::mechanics
