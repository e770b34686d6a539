#include "report/surface.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace koshi::report {
namespace {

// Index arithmetic of a box of places.
struct Box {
  Int3 size;
  std::int64_t count() const { return size[0] * size[1] * size[2]; }
  std::int64_t index(const Int3& at) const { return at[0] + size[0] * (at[1] + size[1] * at[2]); }
  bool holds(const Int3& at) const {
    return std::ranges::all_of(std::array{0, 1, 2}, [&](int a) { return at[a] >= 0 && at[a] < size[a]; });
  }
  template <class F>
  void for_each(F&& f) const {
    for (std::int64_t k = 0; k < size[2]; ++k)
      for (std::int64_t j = 0; j < size[1]; ++j)
        for (std::int64_t i = 0; i < size[0]; ++i) f(Int3{i, j, k});
  }
};

/// Calls f for every place within [lo, hi] that the box holds.
template <class F>
void for_each_within(const Box& box, const Int3& lo, const Int3& hi, F&& f) {
  for (std::int64_t k = std::max<std::int64_t>(lo[2], 0); k <= std::min(hi[2], box.size[2] - 1); ++k)
    for (std::int64_t j = std::max<std::int64_t>(lo[1], 0); j <= std::min(hi[1], box.size[1] - 1); ++j)
      for (std::int64_t i = std::max<std::int64_t>(lo[0], 0); i <= std::min(hi[0], box.size[0] - 1); ++i)
        f(Int3{i, j, k});
}

Box nodes_of(const Box& cells) { return {{cells.size[0] + 1, cells.size[1] + 1, cells.size[2] + 1}}; }

// The body seen in blocks of stride^3 cells.
struct Blocks {
  Box cells;   // of the body
  Box blocks;  // of the thinned body
  std::int64_t stride;
  std::span<const std::uint16_t> material;
  std::vector<std::uint8_t> solid;  // by block

  Blocks(const Box& body, std::span<const std::uint16_t> body_material, std::int64_t block_stride)
      : cells(body), stride(block_stride), material(body_material) {
    for (std::size_t a = 0; a < 3; ++a) blocks.size[a] = (body.size[a] + stride - 1) / stride;
    solid.resize(static_cast<std::size_t>(blocks.count()));
    std::size_t cell = 0;
    body.for_each([&](const Int3& at) {
      if (material[cell++] != 0)
        solid[static_cast<std::size_t>(blocks.index({at[0] / stride, at[1] / stride, at[2] / stride}))] = 1;
    });
  }

  bool is_solid(const Int3& block) const {
    return blocks.holds(block) && solid[static_cast<std::size_t>(blocks.index(block))] != 0;
  }

  bool is_solid_cell(const Int3& cell) const {
    return cells.holds(cell) && material[static_cast<std::size_t>(cells.index(cell))] != 0;
  }

  /// Calls f(block, corners of the face counter-clockwise from outside) for every face between solid and empty.
  template <class F>
  void for_each_face(F&& f) const {
    blocks.for_each([&](const Int3& block) {
      if (!is_solid(block)) return;
      for (std::size_t axis = 0; axis < 3; ++axis)
        for (const int side : {0, 1}) {
          Int3 beyond = block;
          beyond[axis] += side == 0 ? -1 : 1;
          if (is_solid(beyond)) continue;
          // u, v and the axis are right-handed, so low-u, high-u, high-u-high-v, high-v turns about +axis.
          const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
          Int3 corner = block;
          corner[axis] += side;
          std::array<Int3, 4> face{corner, corner, corner, corner};
          ++face[1][u], ++face[2][u], ++face[2][v], ++face[3][v];
          if (side == 0) std::reverse(face.begin(), face.end());
          f(block, face);
        }
    });
  }

  std::int64_t surface_points() const {
    const Box corners = nodes_of(blocks);
    std::vector<bool> on_surface(static_cast<std::size_t>(corners.count()));
    for_each_face([&](const Int3&, const std::array<Int3, 4>& face) {
      for (const Int3& corner : face) on_surface[static_cast<std::size_t>(corners.index(corner))] = true;
    });
    return std::count(on_surface.begin(), on_surface.end(), true);
  }

  /// Node of the body that stands for a corner of blocks: the nearest one that touches a solid cell of the blocks
  /// around the corner.
  Int3 node_for(const Int3& corner) const {
    Int3 centre, lo, hi, nearest{};
    for (std::size_t a = 0; a < 3; ++a) {
      centre[a] = std::min(corner[a] * stride, cells.size[a]);
      lo[a] = centre[a] - stride;
      hi[a] = centre[a] + stride - 1;
    }
    std::int64_t least = std::numeric_limits<std::int64_t>::max();
    for_each_within(cells, lo, hi, [&](const Int3& cell) {
      if (!is_solid_cell(cell)) return;
      Int3 node;
      std::int64_t distance = 0;
      for (std::size_t a = 0; a < 3; ++a) {
        node[a] = std::clamp(centre[a], cell[a], cell[a] + 1);
        distance += (node[a] - centre[a]) * (node[a] - centre[a]);
      }
      if (distance < least) least = distance, nearest = node;
    });
    return nearest;
  }

  /// Cell of the body that stands for a solid block: the solid one nearest to its middle.
  Int3 cell_for(const Int3& block) const {
    Int3 lo, hi, nearest{};
    for (std::size_t a = 0; a < 3; ++a) lo[a] = block[a] * stride, hi[a] = lo[a] + stride - 1;
    std::int64_t least = std::numeric_limits<std::int64_t>::max();
    for_each_within(cells, lo, hi, [&](const Int3& cell) {
      std::int64_t distance = 0;
      for (std::size_t a = 0; a < 3; ++a) distance += std::abs(2 * cell[a] - lo[a] - hi[a]);
      if (distance < least && is_solid_cell(cell)) least = distance, nearest = cell;
    });
    return nearest;
  }
};

// Smallest stride that brings the surface below the limit. A surface of n points has about n/s^2 with stride s, so the
// search starts a little below that.
Blocks thinned(const Box& cells, std::span<const std::uint16_t> material, std::int64_t points, std::int64_t limit) {
  auto stride = static_cast<std::int64_t>(std::sqrt(static_cast<double>(points) / static_cast<double>(limit)));
  stride = std::max<std::int64_t>(2, stride - 1);
  for (;; ++stride) {
    Blocks blocks(cells, material, stride);
    if (blocks.surface_points() <= limit) return blocks;
  }
}

}  // namespace

Surface extract_surface(const Int3& cells, std::span<const std::uint16_t> material, const SurfaceLimits& limits) {
  const Box body{cells}, nodes = nodes_of(body);
  Surface surface;
  Blocks blocks(body, material, 1);
  surface.body_points = blocks.surface_points();
  if (surface.body_points > limits.surface_points)
    blocks = thinned(body, material, surface.body_points, limits.surface_points);
  surface.stride = blocks.stride;

  // Points and cells get their numbers when they are first met.
  const Box corners = nodes_of(blocks.blocks);
  std::vector<std::int32_t> point_at(static_cast<std::size_t>(corners.count()), -1);
  std::vector<std::int32_t> cell_at(static_cast<std::size_t>(blocks.blocks.count()), -1);
  const auto point_of = [&](const Int3& corner) {
    std::int32_t& point = point_at[static_cast<std::size_t>(corners.index(corner))];
    if (point < 0) {
      point = static_cast<std::int32_t>(surface.points.size());
      surface.points.push_back(nodes.index(blocks.stride == 1 ? corner : blocks.node_for(corner)));
    }
    return point;
  };
  const auto cell_of = [&](const Int3& block) {
    std::int32_t& cell = cell_at[static_cast<std::size_t>(blocks.blocks.index(block))];
    if (cell < 0) {
      cell = static_cast<std::int32_t>(surface.cells.size());
      surface.cells.push_back(body.index(blocks.stride == 1 ? block : blocks.cell_for(block)));
    }
    return cell;
  };
  blocks.for_each_face([&](const Int3& block, const std::array<Int3, 4>& face) {
    surface.quads.push_back({point_of(face[0]), point_of(face[1]), point_of(face[2]), point_of(face[3])});
    surface.quad_cell.push_back(cell_of(block));
  });

  surface.has_interior = blocks.stride == 1 && nodes.count() <= limits.interior_points;
  if (surface.has_interior)
    body.for_each([&](const Int3& cell) {
      if (!blocks.is_solid(cell)) return;
      cell_of(cell);
      for (std::int64_t corner = 0; corner < 8; ++corner)
        point_of({cell[0] + (corner & 1), cell[1] + (corner >> 1 & 1), cell[2] + (corner >> 2)});
    });
  return surface;
}

}  // namespace koshi::report
