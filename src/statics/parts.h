// Connected parts of a body.
#pragma once

#include <cstdint>
#include <vector>

#include "koshi/model.h"

namespace koshi::statics {

/// Cells that share a node belong to one part: bonds join the nodes of each cell, and the nodes are shared.
struct Part {
  std::int64_t cells = 0;
  Int3 lo{}, hi{};  ///< box of its cells: lo <= cell < hi
};

/// All parts of a body, the largest first (ties: by box), the same on any number of ranks.
class Parts {
 public:
  /// Collective.
  explicit Parts(const model::SpringLattice& body);

  const std::vector<Part>& list() const { return parts_; }
  /// Part of a node by its local indices, ghosts included; -1: no cell that this rank knows touches it.
  std::int32_t of_node(const Int3& node) const;

 private:
  /// Solid cells first <= i < last of one row of cells.
  struct Run {
    std::int32_t first, last, part;
  };
  void find_runs(const model::SpringLattice& body);
  void join_across_ranks(const model::SpringLattice& body);
  std::size_t row(std::int64_t j, std::int64_t k) const {
    return static_cast<std::size_t>(j + 1 + (owned_[1] + 1) * (k + 1));
  }

  Int3 owned_;
  std::vector<Run> runs_;               ///< row by row; rows -1 ... owned - 1 in y and z
  std::vector<std::int64_t> row_runs_;  ///< first run of each row
  std::vector<Part> parts_;
};

}  // namespace koshi::statics
