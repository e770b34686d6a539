// The body as a box of cells, and the box of nodes that one rank owns.
#pragma once

#include <algorithm>
#include <cstdint>

#include "koshi/lattice.h"

namespace koshi::lattice {

/// A box of cells; node (i, j, k) lies at origin + d (i, j, k). In a periodic direction the last layer of nodes is the
/// first one.
struct Grid {
  Int3 cells{};                    ///< along each axis
  double d = 0;                    ///< spacing [m]
  Vec3 origin{};                   ///< lower corner [m]
  std::array<bool, 3> periodic{};  ///< opposite faces are joined

  /// Nodes along each axis.
  Int3 nodes() const {
    Int3 n;
    for (int a = 0; a < 3; ++a) n[a] = cells[a] + (periodic[a] ? 0 : 1);
    return n;
  }
  /// Of the whole box, empty or not.
  std::int64_t node_count() const {
    const Int3 n = nodes();
    return n[0] * n[1] * n[2];
  }
  /// Likewise.
  std::int64_t cell_count() const { return cells[0] * cells[1] * cells[2]; }
  /// Of a global node [m].
  Vec3 position(const Int3& node) const {
    return {origin[0] + d * static_cast<double>(node[0]), origin[1] + d * static_cast<double>(node[1]),
            origin[2] + d * static_cast<double>(node[2])};
  }
};

/// The nodes of one rank. *Owned* nodes are those the rank computes, local indices 0 ... owned - 1 per axis; one layer
/// of *ghost* nodes around them (-1 and owned) holds copies of the neighbours' nodes, or nothing outside the body. In
/// memory x runs fastest:
///     index(i, j, k) = lead + i + pitch (j + 1 + (owned_y + 2) (k + 1)),
/// rows start on a multiple of the SIMD width, so every row's first owned node is 64-byte aligned, and whole vectors
/// may be read and written up to the end of the row. A cell has the index of its corner with the smallest coordinates.
class Layout {
 public:
  static constexpr std::int64_t lead = 8;  ///< elements before a row's first owned node

  Layout() = default;
  /// Global indices of the first owned node, and owned nodes along each axis.
  Layout(const Int3& begin, const Int3& owned)
      : begin_(begin), owned_(owned), pitch_(lead + (owned[0] + lead) / lead * lead), plane_(pitch_ * (owned[1] + 2)) {}

  const Int3& begin() const { return begin_; }   ///< global indices of the first owned node
  const Int3& owned() const { return owned_; }   ///< owned nodes per axis
  std::int64_t pitch() const { return pitch_; }  ///< from a node to the next along y
  std::int64_t plane() const { return plane_; }  ///< from a node to the next along z
  /// Number of array elements of one component, ghosts and padding included.
  std::int64_t size() const { return plane_ * (owned_[2] + 2) + 4 * lead; }
  std::int64_t owned_count() const { return owned_[0] * owned_[1] * owned_[2]; }  ///< owned nodes in all

  /// Place in memory of a local node, each index from -1 to owned.
  std::int64_t index(std::int64_t i, std::int64_t j, std::int64_t k) const {
    return lead + i + pitch_ * (j + 1) + plane_ * (k + 1);
  }
  std::int64_t index(const Int3& node) const { return index(node[0], node[1], node[2]); }  ///< the same
  /// Local indices of the node at a place in memory.
  Int3 place(std::int64_t index) const {
    const std::int64_t from = index - this->index(-1, -1, -1);
    return {from % plane_ % pitch_ - 1, from % plane_ / pitch_ - 1, from / plane_ - 1};
  }
  /// Distance in memory between a node and its neighbour in direction s.
  std::int64_t offset(const std::array<int, 3>& s) const { return s[0] + pitch_ * s[1] + plane_ * s[2]; }

  /// Local indices of a global node; owned if every one lies in [0, owned).
  Int3 local(const Int3& global) const { return {global[0] - begin_[0], global[1] - begin_[1], global[2] - begin_[2]}; }
  /// Global indices of a local node.
  Int3 global(const Int3& node) const { return {node[0] + begin_[0], node[1] + begin_[1], node[2] + begin_[2]}; }
  /// Of a local node.
  bool owns(const Int3& node) const {
    for (int a = 0; a < 3; ++a)
      if (node[a] < 0 || node[a] >= owned_[a]) return false;
    return true;
  }

 private:
  Int3 begin_{}, owned_{};
  std::int64_t pitch_ = 0, plane_ = 0;
};

/// Calls f(i, j, k, index) for all nodes with lo <= (i, j, k) < hi, x fastest.
template <class F>
void for_each(const Layout& layout, const Int3& lo, const Int3& hi, F&& f) {
  for (std::int64_t k = lo[2]; k < hi[2]; ++k)
    for (std::int64_t j = lo[1]; j < hi[1]; ++j) {
      std::int64_t n = layout.index(lo[0], j, k);
      for (std::int64_t i = lo[0]; i < hi[0]; ++i, ++n) f(i, j, k, n);
    }
}

/// The same for all owned nodes.
template <class F>
void for_each_owned(const Layout& layout, F&& f) {
  for_each(layout, {0, 0, 0}, layout.owned(), f);
}

}  // namespace koshi::lattice
