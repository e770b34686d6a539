#include "statics/node_blocks.h"

#include <Eigen/Cholesky>

#include <array>
#include <string>
#include <unordered_map>

#include "statics/cell_springs.h"

namespace koshi::statics {
namespace {

using mechanics::block_width;
using mechanics::cell_constants;
/// A node's block, without memory of its own on the heap.
using Block = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 6, 6>;

/// What a node's block has beside that of the springs.
using More = mechanics::CutForces::NodeBlock;

/// The four rows of cells around a row of nodes: r = 0 ... 3 for (j, k), (j-1, k), (j, k-1), (j-1, k-1).
using CellRows = std::array<std::int32_t, 4>;

/// Makes the blocks of one group of nodes.
class BlockMaker {
 public:
  BlockMaker(const SpringRows& springs, int components) : springs_(springs), components_(components) {
    const auto basis = cell_basis(components);
    for (int q = 0; q < cell_constants; ++q)
      for (int corner = 0; corner < 8; ++corner)
        corner_[q][corner] = basis[q].block(corner * components, corner * components, components, components);
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
      for (int p = 0; p < components_; ++p)
        for (int q = 0; q < components_; ++q) K(p, q) = more->stiffness[static_cast<std::size_t>(6 * p + q)];
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

  /// Are all cells around nodes first ... last - 1 alike and not empty?
  bool is_uniform(const CellRows& rows, std::int64_t first, std::int64_t last) const {
    for (int q = 0; q < cell_constants; ++q) {
      const float k = constant(rows, first, 0, q);
      for (std::int64_t i = first; i < last; ++i)
        for (int corner = 0; corner < 8; ++corner)
          if (constant(rows, i, corner, q) != k) return false;
    }
    return !is_empty(rows, first);
  }

 private:
  // Constant q of the cell in which node i is the corner; corner bits: 1 = the node is the cell's upper end.
  float constant(const CellRows& rows, std::int64_t i, int corner, int q) const {
    return springs_.constants(rows[static_cast<std::size_t>(corner >> 1)])[q * springs_.pitch() + i - (corner & 1)];
  }

  const SpringRows& springs_;
  int components_;
  std::array<std::array<Block, 8>, cell_constants> corner_;
};

/// A group of nodes with blocks of its own.
struct Group {
  CellRows rows;
  std::int64_t first, last;
  std::array<FixedNode, block_width> held;
  const More* more;  ///< of its nodes, as many as `more_count`
  std::int64_t more_count;
};

}  // namespace

NodeBlocks::NodeBlocks(const SpringRows& springs, const FixedNodes& fixed, int components,
                       const std::vector<More>& more)
    : owned_y_(springs.owned()[1]), groups_per_row_((springs.owned()[0] + block_width - 1) / block_width) {
  const Int3& owned = springs.owned();
  const BlockMaker maker(springs, components);
  std::unordered_map<std::string, std::int32_t> known;
  std::vector<Group> distinct;
  auto next_fixed = fixed.begin();
  auto next_more = more.begin();
  for (std::int64_t k = 0; k < owned[2]; ++k)
    for (std::int64_t j = 0; j < owned[1]; ++j) {
      const CellRows rows{springs.row(j, k), springs.row(j - 1, k), springs.row(j, k - 1), springs.row(j - 1, k - 1)};
      bool empty = true;
      for (const std::int32_t r : rows) empty = empty && springs.span(r).first == springs.span(r).last;
      empty_.push_back(empty);
      for (std::int64_t first = 0; first < owned[0]; first += block_width) {
        const std::int64_t last = std::min(first + block_width, owned[0]);
        Group group{rows, first, last, {}, more.data() + (next_more - more.begin()), 0};
        for (;
             next_more != more.end() && next_more->node[2] == k && next_more->node[1] == j && next_more->node[0] < last;
             ++next_more)
          ++group.more_count;
        bool any_fixed = false;
        for (; next_fixed != fixed.end() && next_fixed->node[2] == k && next_fixed->node[1] == j &&
               next_fixed->node[0] < last;
             ++next_fixed) {
          group.held[static_cast<std::size_t>(next_fixed->node[0] - first)] = *next_fixed;
          any_fixed = true;
        }
        if (empty) {
          groups_.push_back(0);
          continue;
        }
        if (group.more_count > 0) {
          groups_.push_back(static_cast<std::int32_t>(distinct.size()));
          distinct.push_back(group);
          continue;
        }
        std::string key(reinterpret_cast<const char*>(rows.data()), sizeof rows);
        key.append(reinterpret_cast<const char*>(&first), sizeof first);
        for (std::size_t i = 0; any_fixed && i < group.held.size(); ++i) {
          key.push_back(static_cast<char>(group.held[i].mask));
          key.append(reinterpret_cast<const char*>(group.held[i].spring.data()), sizeof group.held[i].spring);
        }
        const auto [entry, is_new] = known.try_emplace(key, 0);
        if (is_new && !any_fixed && maker.is_uniform(rows, first, last)) {
          // By symmetry the block is a multiple of one for displacements and for rotations.
          entry->second = ~static_cast<std::int32_t>(uniform_.size() / 2);
          const Block B = maker.inverse(rows, first, {}, nullptr);
          uniform_.push_back(static_cast<float>(B(0, 0)));
          uniform_.push_back(static_cast<float>(B(components - 1, components - 1)));
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
  for (std::size_t g = 0; g < distinct.size(); ++g) {
    const Group& group = distinct[g];
    const More* of_node = group.more;
    for (std::int64_t i = group.first; i < group.last; ++i) {
      const bool has = of_node != group.more + group.more_count && of_node->node[0] == i;
      const More* const beside = has ? of_node++ : nullptr;
      if (maker.is_empty(group.rows, i)) continue;
      const Block B = maker.inverse(group.rows, i, group.held[static_cast<std::size_t>(i - group.first)], beside);
      float* to = blocks_.data() + g * set + (i - group.first);
      for (int a = 0; a < components; ++a)
        for (int b = 0; b <= a; ++b, to += block_width) *to = static_cast<float>(B(a, b));
    }
  }
}

}  // namespace koshi::statics
