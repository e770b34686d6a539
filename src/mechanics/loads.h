// Loads and prescribed motions, row by row.
#pragma once

#include <optional>
#include <vector>

#include "koshi/model.h"
#include "model/formula.h"

namespace koshi::mechanics {

/// Entries of a list sorted by node that lie in each row of owned nodes.
class RowIndex {
 public:
  RowIndex() = default;
  /// `node_of(entry)` gives the node's index; the list must be in memory order.
  template <class List, class NodeOf>
  RowIndex(const lattice::Layout& layout, const List& list, NodeOf&& node_of) {
    std::size_t at = 0;
    for (std::int64_t k = 0; k < layout.owned()[2]; ++k)
      for (std::int64_t j = 0; j < layout.owned()[1]; ++j) {
        first_.push_back(at);
        while (at < list.size() && node_of(list[at]) < layout.index(layout.owned()[0], j, k)) ++at;
      }
    first_.push_back(at);
  }
  std::size_t begin(std::int64_t row) const { return first_[static_cast<std::size_t>(row)]; }
  std::size_t end(std::int64_t row) const { return first_[static_cast<std::size_t>(row) + 1]; }

 private:
  std::vector<std::size_t> first_;
};

/// The model's loads at one time, added to rows of forces.
class LoadRows {
 public:
  explicit LoadRows(const model::Model& model);
  /// Sets the time at which the loads' histories are taken.
  void set_time(double t);
  /// Whether anything is added to row (j, k).
  bool touch(std::int64_t j, std::int64_t k) const;
  /// Adds the loads on row (j, k) to its forces, force[c] pointing to node i = 0.
  void add(std::int64_t j, std::int64_t k, double* const* force) const;

 private:
  const model::Model& model_;
  std::vector<RowIndex> rows_;  ///< by load
  /// Where the profile of a load depends on time: its forces then; by load.
  std::vector<std::optional<model::Formula>> profile_;
  std::vector<std::vector<model::NodeForce>> forces_;
  std::vector<double> scratch_;
  std::vector<double> factor_;  ///< by load
  Vec3 acceleration_{};         ///< of all body forces [m/s^2]
};

}  // namespace koshi::mechanics
