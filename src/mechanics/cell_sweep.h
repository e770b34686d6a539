// The order in which the cells of a box are passed over, so that what neighbours share stays in the caches.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <memory>
#include <utility>
#include <vector>

#include "base/poison.h"
#include "mechanics/cell_strip.h"

namespace koshi::mechanics {

/// Values on the nodes of a box: component 0 of node (0, 0, 0), and the distances in memory to the next component, row
/// in y, and plane in z.
template <class T>
struct NodeValues {
  const T* at;
  std::ptrdiff_t component, row, plane;
  const T* of(std::int64_t i, std::int64_t j, std::int64_t k) const { return at + i + row * j + plane * k; }
};

/// Rows of nodes (j, k) with j0 <= j < j1, k0 <= k < k1.
struct Rows {
  std::int64_t j0, j1, k0, k1;
  bool empty() const { return j0 >= j1 || k0 >= k1; }
};

/// Forces -K u on rows of nodes, summed over the cells around them: cells of a row in x, rows in y, layers in z. Every
/// node's sum has the same terms in the same order wherever the box begins and ends; cells on the border of a box are
/// computed in each of the boxes they touch, so a row's bits do not depend on them.
///
/// Cells go by in blocks of a few rows up through all layers; in a layer, strips of strip_cells cells go by in x, and
/// in a strip the rows in y, so that sums of values are formed once and stay in the first-level cache until the next
/// row.
template <class T>
class CellSweep {
 public:
  /// `nodes` in a row, and `rows` in y at most; `below`: there may be cells below node i = 0; `half_d`: the unit of
  /// rotations; `cache`: bytes of cache for the values of a block.
  CellSweep(int components, std::int64_t nodes, std::int64_t rows, bool below, T half_d, std::int64_t cache)
      : components_(components),
        nodes_(nodes),
        begin_(below ? -lead : 0),
        half_d_(half_d),
        // An odd number of cache lines, so that rows do not compete for the same cache sets.
        pitch_((((nodes + lead - 1) / lead + 1) | 1) * lead),
        // A row of nodes has three planes of displacements, two of velocities and two of forces in the cache.
        block_rows_(
            std::clamp<std::int64_t>(cache / (7 * pitch_ * components * static_cast<std::int64_t>(sizeof(T))) - 2, 4,
                                     std::max<std::int64_t>(rows, 4))),
        strip_(std::make_unique<Strip<T>>()),
        forces_(static_cast<std::size_t>(2 * block_rows_ * components * pitch_ / lead)),
        carries_(static_cast<std::size_t>(block_rows_)) {}

  /// Calls use(j, k, force) for every row once its force is known; force[c] points to node i = 0 and may be changed; it
  /// is valid until the next call. Calls release(j, k) for every row when its values are not needed any more.
  /// `constants(i, j, k, cells, to)` gives the prepared constants of the strip of cells that begins with (i, j, k), or
  /// null if it has no cell; `to` is memory for them, which keeps what was put there last. `fetch(i, j, k, nodes)` says
  /// that use(j, k) comes soon, a strip of nodes at a time: what it needs may be fetched into the cache.
  template <class Constants, class Fetch, class Use, class Release>
  void run(const NodeValues<T>& u, const Rows& rows, Constants&& constants, Fetch&& fetch, Use&& use,
           Release&& release) {
    if (rows.empty()) return;
    for (std::int64_t j0 = rows.j0; j0 < rows.j1; j0 += block_rows_) {
      const Rows block{j0, std::min(j0 + block_rows_, rows.j1), rows.k0, rows.k1};
      for (std::int64_t k = rows.k0 - 1; k < rows.k1; ++k) {
        add_layer(u, block, k, constants, fetch);
        if (k < rows.k0) continue;
        for (std::int64_t j = block.j0; j < block.j1; ++j) {
          std::array<T*, 6> force;
          for (int c = 0; c < components_; ++c) force[c] = force_row(k, j - block.j0).at + c * pitch_;
          use(j, k, force.data());
        }
        // The next block needs the last row of this one.
        const std::int64_t done = block.j1 == rows.j1 ? block.j1 : block.j1 - 1;
        for (std::int64_t j = std::max(block.j0 - 1, rows.j0); j < done; ++j) release(j, k);
      }
    }
  }

  /// From a component of the force to the next.
  std::ptrdiff_t pitch() const { return pitch_; }

 private:
  static constexpr std::int64_t lead = 64 / static_cast<std::int64_t>(sizeof(T));
  struct alignas(64) Line {
    T value[lead];
  };

  // Row `row` of a block in plane k; two planes are kept.
  NodeRow<T> force_row(std::int64_t k, std::int64_t row) {
    T* const rows = forces_.data()->value;
    return {rows + ((k & 1) * block_rows_ + row) * components_ * pitch_ + lead, pitch_};
  }

  // Adds the cells between planes k and k + 1 to the nodes of both.
  template <class Constants, class Fetch>
  void add_layer(const NodeValues<T>& u, const Rows& block, std::int64_t k, Constants&& constants, Fetch&& fetch) {
    for (Carry& carry : carries_) carry = {};
    for (std::int64_t i = begin_; i < nodes_; i += strip_cells) add_strip(u, block, i, k, constants, fetch);
  }

  template <class Constants, class Fetch>
  void add_strip(const NodeValues<T>& u, const Rows& block, std::int64_t i, std::int64_t k, Constants&& constants,
                 Fetch&& fetch) {
    const StripKernels<T>& kernels = strip_kernels<T>();
    Strip<T>& strip = *strip_;
    const std::int64_t cells = std::min(strip_cells, (nodes_ - i + lead - 1) / lead * lead);
    const bool first = k < block.k0;
    const auto motion_of = [&](std::int64_t j, T* values) {
      kernels.transform(components_, half_d_, {u.of(i, j, k), u.component}, {u.of(i, j, k + 1), u.component}, cells,
                        values);
    };
    bool known = false;    // motion[0] belongs to row j of nodes
    bool pending = false;  // the row of cells before gave something to it
    std::memset(strip.pending, 0, sizeof strip.pending);
    for (std::int64_t j = block.j0 - 1; j < block.j1; ++j) {
      const T* const k_cells = constants(i, j, k, cells, strip.constants);
      T *const lower = strip.motion[j & 1], *const upper = strip.motion[(j + 1) & 1];
      if (k_cells != nullptr) {
        if (!known) motion_of(j, lower);
        motion_of(j + 1, upper);
        kernels.cells(components_, k_cells, lower, upper, cells, strip.pending, strip.force);
      } else if (pending) {
        for (int v = 0; v < components_ * pair_values * strip_cells; ++v) strip.force[v] = -strip.pending[v];
        std::memset(strip.pending, 0, sizeof strip.pending);
      }
      const bool any = k_cells != nullptr || pending;
      known = pending = k_cells != nullptr;
      if (j < block.j0) continue;
      if (!first) fetch(i, j, k, cells);
      deliver(any, block, i, j, k, cells, first);
    }
  }

  // Gives the forces of a strip to row (j, k) and the one above it.
  void deliver(bool any, const Rows& block, std::int64_t i, std::int64_t j, std::int64_t k, std::int64_t cells,
               bool first) {
    Carry& carry = carries_[static_cast<std::size_t>(j - block.j0)];
    NodeRow<T> low = force_row(k, j - block.j0), high = force_row(k + 1, j - block.j0);
    low.at += i;
    high.at += i;
    if (!any && !carry.any) {
      for (int c = 0; c < components_; ++c) {
        if (first) std::fill_n(low.at + c * pitch_, cells, T{0});
        std::fill_n(high.at + c * pitch_, cells, T{0});
      }
      return;
    }
    if (!any) std::memset(strip_->force, 0, sizeof strip_->force);
    strip_kernels<T>().deliver(components_, half_d_, strip_->force, cells, first, carry.value.data(), low, high);
    carry.any = any;
  }

  /// What the last cells of a strip give to the nodes behind it.
  struct Carry {
    std::array<T, 12> value{};
    bool any = false;
  };

  int components_;
  std::int64_t nodes_, begin_;
  T half_d_;
  std::int64_t pitch_, block_rows_;
  std::unique_ptr<Strip<T>> strip_;
  std::vector<Line> forces_;
  std::vector<Carry> carries_;
};

}  // namespace koshi::mechanics
