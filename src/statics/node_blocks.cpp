#include "statics/node_blocks.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <unordered_map>

#include "mechanics/strain_tie.h"
#include "statics/cell_springs.h"

namespace koshi::statics {
namespace {

using mechanics::block_width;
using mechanics::cell_constants;
/// A node's block, without memory of its own on the heap.
using Block = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 6, 6>;

// Of the integers that stand for a block's elements.
double unit_of(const Block& B) { return B.cwiseAbs().maxCoeff() / std::numeric_limits<std::int16_t>::max(); }

/// What a node's block has beside that of the springs.
using More = mechanics::CutForces::NodeBlock;

/// The four rows of cells around a row of nodes: r = 0 ... 3 for (j, k), (j-1, k), (j, k-1), (j-1, k-1).
using CellRows = std::array<std::int32_t, 4>;

/// Makes the blocks of one group of nodes.
class BlockMaker {
 public:
  BlockMaker(const SpringRows& springs, int components) : springs_(springs), components_(components) {
    auto basis = cell_basis(components);
    for (int q = 0; q < cell_constants; ++q) {
      if (!springs.tied()) basis[q] = mechanics::without_tie(basis[q]);
      for (int corner = 0; corner < 8; ++corner)
        corner_[q][corner] = basis[q].block(corner * components, corner * components, components, components);
    }
  }

  bool is_empty(const CellRows& rows, std::int64_t i) const {
    for (int corner = 0; corner < 8; ++corner)
      for (int q = 0; q < cell_constants; ++q)
        if (constant(rows, i, corner, q) != 0) return false;
    return true;
  }

  /// Inverse block of node i.
  Block inverse(const CellRows& rows, std::int64_t i, const FixedNode& held, const More* more) const {
    const std::uint8_t fixed = held.mask;
    Block K = Block::Zero(components_, components_);
    if (more != nullptr)
      for (int p = 0; p < 3; ++p)
        for (int q = 0; q < 3; ++q) K(p, q) = more->stiffness[static_cast<std::size_t>(3 * p + q)];
    for (int corner = 0; corner < 8; ++corner)
      for (int q = 0; q < cell_constants; ++q)
        if (const float k = constant(rows, i, corner, q); k != 0) K += k * corner_[q][corner];
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) K(a, b) += static_cast<double>(held.stiffness(a, b));
    for (int c = 0; c < components_; ++c)
      if (fixed >> c & 1) {
        K.row(c).setZero();
        K.col(c).setZero();
        K(c, c) = 1;
      }
    Block B = K.llt().solve(Block::Identity(components_, components_));
    for (int c = 0; c < components_; ++c)
      if (fixed >> c & 1) B(c, c) = 0;
    return B;
  }

  /// Are all cells around nodes first ... last - 1 alike?
  bool is_uniform(const CellRows& rows, std::int64_t first, std::int64_t last) const {
    for (int q = 0; q < cell_constants; ++q) {
      const float k = constant(rows, first, 0, q);
      for (std::int64_t i = first; i < last; ++i)
        for (int corner = 0; corner < 8; ++corner)
          if (constant(rows, i, corner, q) != k) return false;
    }
    return true;
  }

 private:
  // Constant q of the cell in which node i is the corner; corner bits: 1 = the node is the cell's upper end.
  float constant(const CellRows& rows, std::int64_t i, int corner, int q) const {
    return springs_.constant(rows[static_cast<std::size_t>(corner >> 1)], i - (corner & 1), q);
  }

  const SpringRows& springs_;
  int components_;
  std::array<std::array<Block, 8>, cell_constants> corner_;
};

/// A group of nodes with blocks of its own.
struct Group {
  CellRows rows;
  std::int64_t first, last;
  std::span<const FixedNode> held;
  std::span<const More> more;
};

// The first element of a list whose node is i; null if there is none.
template <class T>
const T* of_node(std::span<const T> list, std::int64_t i) {
  const auto found = std::ranges::find_if(list, [i](const T& entry) { return entry.node[0] == i; });
  return found == list.end() ? nullptr : &*found;
}

// What of a list, in memory's order, belongs to nodes of row (j, k) before `last`; moves on behind it.
template <class T>
std::span<const T> part_of(const std::vector<T>& list, std::size_t& next, const Int3& last) {
  const std::size_t first = next;
  while (next < list.size() && list[next].node[2] == last[2] && list[next].node[1] == last[1] &&
         list[next].node[0] < last[0])
    ++next;
  return {list.data() + first, next - first};
}

}  // namespace

NodeBlocks::NodeBlocks(const SpringRows& springs, const FixedNodes& fixed, int components,
                       const std::vector<More>& more)
    : owned_y_(springs.owned()[1]), groups_per_row_((springs.owned()[0] + block_width - 1) / block_width) {
  const Int3& owned = springs.owned();
  const BlockMaker maker(springs, components);
  std::unordered_map<std::string, std::int32_t> known;
  std::vector<Group> distinct;
  std::size_t next_fixed = 0, next_more = 0;
  for (std::int64_t k = 0; k < owned[2]; ++k)
    for (std::int64_t j = 0; j < owned[1]; ++j) {
      const CellRows rows{springs.row(j, k), springs.row(j - 1, k), springs.row(j, k - 1), springs.row(j - 1, k - 1)};
      bool empty = true;
      for (const std::int32_t r : rows) empty = empty && springs.span(r).first == springs.span(r).last;
      empty_.push_back(empty);
      for (std::int64_t first = 0; first < owned[0]; first += block_width) {
        const std::int64_t last = std::min(first + block_width, owned[0]);
        const Int3 end{last, j, k};
        const Group group{rows, first, last, part_of(fixed, next_fixed, end), part_of(more, next_more, end)};
        if (empty) {
          groups_.push_back(0);
          continue;
        }
        if (!group.more.empty()) {
          groups_.push_back(static_cast<std::int32_t>(distinct.size()));
          distinct.push_back(group);
          continue;
        }
        std::string key(reinterpret_cast<const char*>(rows.data()), sizeof rows);
        key.append(reinterpret_cast<const char*>(&first), sizeof first);
        for (const FixedNode& held : group.held) {
          key.push_back(static_cast<char>(held.node[0] - first));
          key.push_back(static_cast<char>(held.mask));
          key.append(reinterpret_cast<const char*>(held.spring.data()), sizeof held.spring);
        }
        const auto [entry, is_new] = known.try_emplace(key, 0);
        if (is_new && group.held.empty() && maker.is_uniform(rows, first, last)) {
          // By symmetry the block is a multiple of one for displacements and for rotations.
          entry->second = ~static_cast<std::int32_t>(uniform_.size() / 3);
          const Block B = maker.is_empty(rows, first) ? Block::Zero(components, components).eval()
                                                      : maker.inverse(rows, first, {}, nullptr);
          // Rounded as in other groups: a node's bits do not depend on where its group begins.
          const double unit = unit_of(B);
          for (const int c : {0, components - 1})
            uniform_.push_back(unit > 0 ? static_cast<float>(std::lround(B(c, c) / unit)) : 0);
          uniform_.push_back(static_cast<float>(unit));
        } else if (is_new) {
          entry->second = static_cast<std::int32_t>(distinct.size());
          distinct.push_back(group);
        }
        groups_.push_back(entry->second);
      }
    }

  // A mixed body has as many distinct groups as nodes: their memory is taken once, at its size.
  const std::size_t set = static_cast<std::size_t>(components * (components + 1) / 2 * block_width);
  blocks_.resize(distinct.size() * set);
  units_.resize(distinct.size() * static_cast<std::size_t>(block_width));
  for (std::size_t g = 0; g < distinct.size(); ++g) {
    const Group& group = distinct[g];
    for (std::int64_t i = group.first; i < group.last; ++i) {
      if (maker.is_empty(group.rows, i)) continue;
      const FixedNode* const held = of_node(group.held, i);
      const Block B = maker.inverse(group.rows, i, held != nullptr ? *held : FixedNode{}, of_node(group.more, i));
      const double unit = unit_of(B);
      const auto node = static_cast<std::size_t>(i - group.first);
      units_[g * static_cast<std::size_t>(block_width) + node] = static_cast<float>(unit);
      if (unit == 0) continue;
      std::int16_t* to = blocks_.data() + g * set + node;
      for (int a = 0; a < components; ++a)
        for (int b = 0; b <= a; ++b, to += block_width) *to = static_cast<std::int16_t>(std::lround(B(a, b) / unit));
    }
  }
}

}  // namespace koshi::statics
