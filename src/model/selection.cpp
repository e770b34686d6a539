#include "model/selection.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace koshi::model {
namespace {

constexpr std::array<const char*, 6> face_names{"x-min", "x-max", "y-min", "y-max", "z-min", "z-max"};

// Positions are compared with this tolerance in spacings, far above rounding and far below a cell.
constexpr double tolerance = 1e-6;

std::string text(const Vec3& p) { return fmt::format("({:.6g}, {:.6g}, {:.6g}) m", p[0], p[1], p[2]); }

}  // namespace

NodeBox select(const Selection& selection, const lattice::Grid& grid, const Places& places, const std::string& path) {
  const Int3 n = grid.nodes();
  NodeBox box{{0, 0, 0}, {n[0] - 1, n[1] - 1, n[2] - 1}};
  if (selection.face) {
    const int face = static_cast<int>(*selection.face);
    const int axis = face / 2;
    if (grid.periodic[axis])
      throw InputError(places.find(path + ".face"), fmt::format("face {} does not exist: the body is periodic in {}",
                                                                face_names[face], "xyz"[axis]));
    box.lo[axis] = box.hi[axis] = face % 2 == 0 ? 0 : n[axis] - 1;
    return box;
  }
  // Corners of a box or a point in units of the spacing.
  const auto scaled = [&](const Vec3& p, int a) { return (p[a] - grid.origin[a]) / grid.d; };
  if (selection.point) {
    for (int a = 0; a < 3; ++a) {
      const double x = scaled(*selection.point, a);
      if (!(x > -0.5 - tolerance && x < static_cast<double>(n[a]) - 0.5 + tolerance))
        throw InputError(places.find(path + ".point"),
                         fmt::format("point {} lies outside the body, which spans {} to {}", text(*selection.point),
                                     text(grid.origin), text(grid.position({n[0] - 1, n[1] - 1, n[2] - 1}))));
      box.lo[a] = box.hi[a] = std::clamp<std::int64_t>(std::llround(x), 0, n[a] - 1);
    }
    return box;
  }
  for (int a = 0; a < 3; ++a) {
    const double last = static_cast<double>(n[a] - 1);
    const double lo = std::ceil(scaled(selection.box->first, a) - tolerance);
    const double hi = std::floor(scaled(selection.box->second, a) + tolerance);
    box.lo[a] = static_cast<std::int64_t>(std::clamp(lo, 0.0, last + 1));
    box.hi[a] = static_cast<std::int64_t>(std::clamp(hi, -1.0, last));
    if (box.lo[a] > box.hi[a])
      throw InputError(places.find(path + ".box"),
                       fmt::format("box {} to {} holds no node; nodes lie every {:.6g} m from {} to {}",
                                   text(selection.box->first), text(selection.box->second), grid.d, text(grid.origin),
                                   text(grid.position({n[0] - 1, n[1] - 1, n[2] - 1}))));
  }
  return box;
}

std::vector<SelectedNode> selected_nodes(const SpringLattice& body, const NodeBox& box) {
  const lattice::Layout& layout = body.layout;
  const std::uint16_t* cell = body.cell.component(0);
  const Int3 begin = layout.local(box.lo), end = layout.local(box.hi);
  Int3 lo, hi;
  for (int a = 0; a < 3; ++a) {
    lo[a] = std::max<std::int64_t>(begin[a], 0);
    hi[a] = std::min(end[a] + 1, layout.owned()[a]);
  }
  const double quarter = 0.25 * body.grid.d * body.grid.d;
  const std::array<std::int64_t, 3> step{1, layout.pitch(), layout.plane()};

  std::vector<SelectedNode> nodes;
  lattice::for_each(layout, lo, hi, [&](auto i, auto j, auto k, auto n) {
    SelectedNode node{n, layout.global({i, j, k}), {}, 0};
    bool solid = false;
    // The twelve cell faces that meet at the node: for each normal a, one in each quadrant of the other two axes b, c.
    for (int a = 0; a < 3; ++a) {
      const int b = (a + 1) % 3, c = (a + 2) % 3;
      for (int qb = -1; qb <= 0; ++qb)
        for (int qc = -1; qc <= 0; ++qc) {
          const std::int64_t above = n + qb * step[b] + qc * step[c];
          const bool solid_above = cell[above] != 0, solid_below = cell[above - step[a]] != 0;
          solid = solid || solid_above || solid_below;
          Int3 opposite = node.global;
          opposite[b] += 2 * qb + 1;
          opposite[c] += 2 * qc + 1;
          for (const int t : {b, c})
            if (body.grid.periodic[t]) opposite[t] = (opposite[t] + body.grid.cells[t]) % body.grid.cells[t];
          if (solid_above == solid_below || !box.contains(opposite)) continue;
          node.outward[a] += solid_below ? quarter : -quarter;
          node.area += quarter;
        }
    }
    if (solid) nodes.push_back(node);
  });
  return nodes;
}

}  // namespace koshi::model
