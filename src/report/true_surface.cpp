#include "report/true_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <unordered_map>

#include "model/cut.h"
#include "model/region_surface.h"
#include "model/surface_loads.h"

namespace koshi::report {
namespace {

// Pieces are looked for so many cells around a point.
constexpr std::int64_t reach = 2;
// Steps between a surface and the border that is not to be left; each brings the point closer to both.
constexpr int steps_to_rim = 4;
// A point this close to the true surface is on it, in cells.
constexpr double on_surface = 1e-6;

/// The place of a triangle that is closest to a point: of its plane, an edge or a corner (C. Ericson, Real-Time
/// Collision Detection, 2005, section 5.1.5).
Vec3 closest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a;
  const double a_ab = dot(ab, p - a), a_ac = dot(ac, p - a);
  if (a_ab <= 0 && a_ac <= 0) return a;
  const double b_ab = dot(ab, p - b), b_ac = dot(ac, p - b);
  if (b_ab >= 0 && b_ac <= b_ab) return b;
  const double c_ab = dot(ab, p - c), c_ac = dot(ac, p - c);
  if (c_ac >= 0 && c_ab <= c_ac) return c;
  const double beyond_ab = a_ab * b_ac - b_ab * a_ac;
  if (beyond_ab <= 0 && a_ab >= 0 && b_ab <= 0) return a + (a_ab / (a_ab - b_ab)) * ab;
  const double beyond_ac = c_ab * a_ac - a_ab * c_ac;
  if (beyond_ac <= 0 && a_ac >= 0 && c_ac <= 0) return a + (a_ac / (a_ac - c_ac)) * ac;
  const double beyond_bc = b_ab * c_ac - c_ab * b_ac, to_c = b_ac - b_ab, to_b = c_ab - c_ac;
  if (beyond_bc <= 0 && to_c >= 0 && to_b >= 0) return b + (to_c / (to_c + to_b)) * (c - b);
  const double whole = beyond_ab + beyond_ac + beyond_bc;
  return a + (beyond_ac / whole) * ab + (beyond_ab / whole) * ac;
}

/// The surfaces of all regions, looked up by place.
class Pieces {
 public:
  struct Hit {
    Vec3 at{};    // [m]
    Int3 cell{};  // the solid cell behind it
    double distance = std::numeric_limits<double>::max();
  };

  Pieces(const model::Definition& definition, const lattice::Grid& grid) : grid_(grid) {
    for (std::size_t r = 0; r < definition.regions.size(); ++r)
      for (model::SurfacePiece& piece :
           model::surface_of(definition, grid, static_cast<int>(r), model::SurfaceEdges::fine)) {
        if (on_border(piece)) continue;  // where the body ends with the grid anyway
        at_[key(cell_of(piece.at))].push_back(pieces_.size());
        pieces_.push_back(std::move(piece));
      }
  }

  /// The closest place of the surface, if any is near. A ring of cells farther out counts only if nothing in the
  /// rings before is as close as it.
  std::optional<Hit> closest(const Vec3& x) const {
    const Int3 centre = cell_of(x);
    Hit hit;
    for (std::int64_t ring = 0; ring <= reach; ++ring) {
      if (hit.distance < static_cast<double>(ring - 1) * grid_.d) break;
      for (std::int64_t k = -ring; k <= ring; ++k)
        for (std::int64_t j = -ring; j <= ring; ++j)
          for (std::int64_t i = -ring; i <= ring; ++i)
            if (std::max({std::abs(i), std::abs(j), std::abs(k)}) == ring)
              look_in({centre[0] + i, centre[1] + j, centre[2] + k}, x, hit);
    }
    if (hit.distance > static_cast<double>(reach) * grid_.d) return std::nullopt;
    return hit;
  }

 private:
  bool on_border(const model::SurfacePiece& piece) const {
    const Vec3 lo = grid_.origin, hi = grid_.position(grid_.cells);
    for (std::size_t a = 0; a < 3; ++a)
      for (const double border : {lo[a], hi[a]})
        if (std::ranges::all_of(piece.corners,
                                [&](const Vec3& x) { return std::abs(x[a] - border) < on_surface * grid_.d; }))
          return true;
    return false;
  }

  Int3 cell_of(const Vec3& x) const {
    Int3 cell;
    for (std::size_t a = 0; a < 3; ++a)
      cell[a] = static_cast<std::int64_t>(std::floor((x[a] - grid_.origin[a]) / grid_.d));
    return cell;
  }

  // Cells a few beyond the grid have a number of their own too.
  std::int64_t key(const Int3& cell) const {
    const std::int64_t margin = 2 * reach + 2;
    return cell[0] + margin +
           (grid_.cells[0] + 2 * margin) * (cell[1] + margin + (grid_.cells[1] + 2 * margin) * (cell[2] + margin));
  }

  void look_in(const Int3& cell, const Vec3& x, Hit& hit) const {
    const auto there = at_.find(key(cell));
    if (there == at_.end()) return;
    for (const std::size_t p : there->second) {
      const model::SurfacePiece& piece = pieces_[p];
      for (std::size_t v = 2; v < piece.corners.size(); ++v) {
        const Vec3 at = closest_on_triangle(x, piece.corners[0], piece.corners[v - 1], piece.corners[v]);
        if (const double distance = norm(at - x); distance < hit.distance) hit = {at, piece.cell, distance};
      }
    }
  }

  lattice::Grid grid_;
  std::vector<model::SurfacePiece> pieces_;
  std::unordered_map<std::int64_t, std::vector<std::size_t>> at_;  // by key of the cell of their middle
};

/// Points of the surface of cells as places of the grid.
struct Points {
  const lattice::Grid& grid;
  const Surface& surface;

  Int3 node(std::size_t point) const {
    std::int64_t rest = surface.points[point];
    Int3 at;
    for (std::size_t a = 0; a < 3; ++a) at[a] = rest % (grid.cells[a] + 1), rest /= grid.cells[a] + 1;
    return at;
  }
  bool on_border(const Int3& node, std::size_t axis) const { return node[axis] == 0 || node[axis] == grid.cells[axis]; }
  std::int64_t index(const Int3& node) const {
    return node[0] + (grid.cells[0] + 1) * (node[1] + (grid.cells[1] + 1) * node[2]);
  }
};

/// Calls f(cell, x) for the cells of the grid around a node, x a little inside of each beside the node.
template <class F>
void for_each_around(const lattice::Grid& grid, const Int3& node, F&& f) {
  constexpr double beside = 1e-3;
  for (int corner = 0; corner < 8; ++corner) {
    Int3 cell;
    Vec3 x = grid.position(node);
    bool there = true;
    for (std::size_t a = 0; a < 3; ++a) {
      const bool lower = corner >> a & 1;
      cell[a] = node[a] - (lower ? 1 : 0);
      x[a] += (lower ? -beside : beside) * grid.d;
      there = there && cell[a] >= 0 && cell[a] < grid.cells[a];
    }
    if (there) f(cell, x);
  }
}

// Whether the body fills one of the cells around a node right beside it.
bool fills(const model::CutBody& body, const lattice::Grid& grid, const Int3& node) {
  bool any = false;
  for_each_around(grid, node, [&](const Int3& cell, const Vec3& x) { any = any || body.material_at(x, cell) != 0; });
  return any;
}

// Whether a surface cuts one of the cells around a node, be it so little that the cell is whole or empty.
bool beside_cut(const model::CutBody& body, const lattice::Grid& grid, const Int3& node) {
  bool any = false;
  for_each_around(grid, node, [&](const Int3& cell, const Vec3&) {
    const model::CellPart part = body.part_of(cell);
    any = any || part.left_out > 0 || (part.fraction > 0 && part.fraction < 1);
  });
  return any;
}

// Points on the border of the grid that are surface of the body where they are, and for the others the axes along which
// they are not to move: those across a border whose faces of cells the body fills in part.
struct Border {
  std::vector<char> stays;
  std::vector<std::array<bool, 3>> held;

  Border(const model::CutBody& body, const Points& points) {
    const std::size_t count = points.surface.points.size();
    stays.resize(count);
    held.resize(count);
    for (std::size_t p = 0; p < count; ++p) {
      const Int3 node = points.node(p);
      if (points.on_border(node, 0) || points.on_border(node, 1) || points.on_border(node, 2))
        stays[p] = fills(body, points.grid, node);
    }
    for (const auto& quad : points.surface.quads)
      for (std::size_t a = 0; a < 3; ++a) {
        const auto along = [&](std::int32_t p) { return points.node(static_cast<std::size_t>(p))[a]; };
        const std::int64_t first = along(quad[0]);
        if (first != 0 && first != points.grid.cells[a]) continue;
        if (!std::ranges::all_of(quad, [&](std::int32_t p) { return along(p) == first; })) continue;
        if (std::ranges::none_of(quad, [&](std::int32_t p) { return stays[static_cast<std::size_t>(p)] != 0; }))
          continue;
        for (const std::int32_t p : quad) held[static_cast<std::size_t>(p)][a] = true;
      }
  }
};

}  // namespace

std::vector<MovedPoint> true_surface(const model::Definition& definition, const lattice::Grid& grid,
                                     const Surface& surface) {
  const Pieces pieces(definition, grid);
  const Points points{grid, surface};
  const model::CutBody body(definition, grid);
  const Border border(body, points);
  std::vector<char> shown(surface.points.size(), 0);  // the inside has points too
  for (const auto& quad : surface.quads)
    for (const std::int32_t point : quad) shown[static_cast<std::size_t>(point)] = 1;

  std::vector<MovedPoint> moved;
  for (std::size_t p = 0; p < surface.points.size(); ++p) {
    if (shown[p] == 0 || border.stays[p] != 0) continue;
    const Int3 node = points.node(p);
    const Vec3 start = grid.position(node);
    auto hit = pieces.closest(start);
    if (!hit || hit->distance < on_surface * grid.d) continue;
    // Faces of cells that no region made, as those of an image, are surface of the body where they are.
    if (!beside_cut(body, grid, node)) continue;
    const auto& held = border.held[p];
    const bool slides = held[0] || held[1] || held[2];
    for (int step = 0; slides && step < steps_to_rim; ++step) {
      Vec3 x = hit->at;
      for (std::size_t a = 0; a < 3; ++a)
        if (held[a]) x[a] = start[a];
      if (auto next = pieces.closest(x)) hit = next;
      for (std::size_t a = 0; a < 3; ++a)
        if (held[a]) hit->at[a] = start[a];
    }

    MovedPoint& point = moved.emplace_back();
    point.point = static_cast<std::int32_t>(p);
    point.at = hit->at;
    const auto shares = model::corner_shares(grid, hit->cell, hit->at);
    for (std::size_t c = 0; c < 8; ++c) {
      Int3 corner = hit->cell;
      for (std::size_t a = 0; a < 3; ++a) corner[a] += c >> a & 1;
      point.nodes[c] = points.index(corner);
      point.weights[c] = static_cast<float>(shares[c].weight);
    }
  }
  return moved;
}

}  // namespace koshi::report
