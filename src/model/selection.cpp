#include "model/selection.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <set>

#include "model/region_surface.h"
#include "model/shapes.h"

namespace koshi::model {
namespace {

constexpr std::array<const char*, 6> face_names{"x-min", "x-max", "y-min", "y-max", "z-min", "z-max"};

// Positions are compared with this tolerance in spacings, far above rounding and far below a cell.
constexpr double tolerance = 1e-6;

std::string text(const Vec3& p) { return fmt::format("({:.6g}, {:.6g}, {:.6g}) m", p[0], p[1], p[2]); }

// The body of a selection as a region, if it is one with a curved or oblique border.
std::optional<RegionDefinition> shape_of(const Selection& selection) {
  using Shape = RegionDefinition::Shape;
  RegionDefinition region;
  if (selection.sphere) {
    region.shape = Shape::sphere;
    region.center = selection.sphere->center;
    region.radius = selection.sphere->radius;
  } else if (selection.cylinder) {
    region.shape = Shape::cylinder;
    region.start = selection.cylinder->start;
    region.end = selection.cylinder->end;
    region.radius = selection.cylinder->radius;
  } else if (selection.half_space) {
    region.shape = Shape::half_space;
    region.point = selection.half_space->point;
    region.normal = selection.half_space->normal;
  } else {
    return std::nullopt;
  }
  return region;
}

bool inside(const std::vector<Primitive>& primitives, const Vec3& x, double slack) {
  return std::all_of(primitives.begin(), primitives.end(),
                     [&](const Primitive& primitive) { return primitive.distance(x) <= slack; });
}

// Combines what the parts of a union, intersection or difference say of one node or place.
template <class Holds>
bool combined(const Selection& selection, Holds&& holds) {
  if (!selection.any_of.empty()) return std::any_of(selection.any_of.begin(), selection.any_of.end(), holds);
  if (!selection.all_of.empty()) return std::all_of(selection.all_of.begin(), selection.all_of.end(), holds);
  const std::vector<std::string>& names = selection.first_of;
  return holds(names.front()) && std::none_of(names.begin() + 1, names.end(), holds);
}

std::vector<std::string> parts_of(const Selection& selection) {
  std::vector<std::string> names = selection.any_of;
  names.insert(names.end(), selection.all_of.begin(), selection.all_of.end());
  names.insert(names.end(), selection.first_of.begin(), selection.first_of.end());
  if (!selection.named.empty()) names.push_back(selection.named);
  return names;
}

// Corners of the cells that feel a region's surface.
std::set<Int3> nodes_of_surface(const Definition& definition, const lattice::Grid& grid, int region) {
  std::set<Int3> nodes;
  for (const SurfacePiece& piece : surface_of(definition, grid, region))
    for (int c = 0; c < 8; ++c) {
      Int3 node{piece.cell[0] + (c & 1), piece.cell[1] + (c >> 1 & 1), piece.cell[2] + (c >> 2)};
      for (std::size_t a = 0; a < 3; ++a)
        if (grid.periodic[a]) node[a] %= grid.cells[a];
      nodes.insert(node);
    }
  return nodes;
}

}  // namespace

std::size_t find_selection(const Definition& definition, const std::string& name) {
  const auto& all = definition.selections;
  const auto found = std::find_if(all.begin(), all.end(), [&](const auto& s) { return s.name == name; });
  assert(found != all.end());
  return static_cast<std::size_t>(found - all.begin());
}

int find_region(const Definition& definition, const std::string& name) {
  const auto& all = definition.regions;
  const auto found = std::find_if(all.begin(), all.end(), [&](const auto& r) { return r.name == name; });
  assert(found != all.end());
  return static_cast<int>(found - all.begin());
}

std::vector<int> surfaces_of(const Selection& selection, const Definition& definition) {
  std::set<int> regions;
  if (!selection.surface.empty()) regions.insert(find_region(definition, selection.surface));
  for (const std::string& name : parts_of(selection)) {
    const auto below = surfaces_of(definition.selections[find_selection(definition, name)].selection, definition);
    regions.insert(below.begin(), below.end());
  }
  return {regions.begin(), regions.end()};
}

bool holds(const Selection& selection, const Definition& definition, const Vec3& place, int region) {
  const double slack = tolerance * definition.lattice.spacing;
  if (!selection.surface.empty()) return find_region(definition, selection.surface) == region;
  if (const auto shape = shape_of(selection)) return inside(primitives_of(*shape), place, slack);
  if (selection.box) {
    for (std::size_t a = 0; a < 3; ++a)
      if (place[a] < selection.box->first[a] - slack || place[a] > selection.box->second[a] + slack) return false;
    return true;
  }
  if (selection.face || selection.point) return false;
  const auto by_name = [&](const std::string& name) {
    return holds(definition.selections[find_selection(definition, name)].selection, definition, place, region);
  };
  return selection.named.empty() ? combined(selection, by_name) : by_name(selection.named);
}

NodeSet select(const Selection& selection, const Definition& definition, const lattice::Grid& grid,
               const std::string& path) {
  const Places& places = definition.places;
  const Int3 n = grid.nodes();
  NodeSet box{{0, 0, 0}, {n[0] - 1, n[1] - 1, n[2] - 1}, {}};
  if (!selection.named.empty()) {
    const std::size_t s = find_selection(definition, selection.named);
    return select(definition.selections[s].selection, definition, grid, fmt::format("selection[{}]", s));
  }
  if (!selection.surface.empty()) {
    const int region = find_region(definition, selection.surface);
    auto nodes = std::make_shared<const std::set<Int3>>(nodes_of_surface(definition, grid, region));
    if (nodes->empty())
      throw InputError(
          places.find(path + ".surface"),
          fmt::format("the surface of region \"{}\" is no surface of the body: on both sides of it lies the "
                      "same, or it lies outside; name another region, or move this one",
                      selection.surface));
    box.named = [nodes = std::move(nodes)](const Int3& node) { return nodes->contains(node); };
    return box;
  }
  if (const auto shape = shape_of(selection)) {
    box.named = [primitives = primitives_of(*shape), grid](const Int3& node) {
      return inside(primitives, grid.position(node), tolerance * grid.d);
    };
    return box;
  }
  if (!parts_of(selection).empty()) {
    // The parts by name: each is asked through the combination.
    std::map<std::string, NodeSet> sets;
    for (const std::string& name : parts_of(selection)) {
      const std::size_t s = find_selection(definition, name);
      sets[name] = select(definition.selections[s].selection, definition, grid, fmt::format("selection[{}]", s));
    }
    box.named = [sets = std::move(sets), &selection](const Int3& node) {
      return combined(selection, [&](const std::string& name) { return sets.at(name).contains(node); });
    };
    return box;
  }
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

namespace {

// Calls f(node, solid, quarters) for owned nodes of the set: whether one of their cells is solid, and their quarters of
// faces.
template <class F>
void for_each_selected(const SpringLattice& body, const NodeSet& box, F&& f) {
  const lattice::Layout& layout = body.layout;
  const std::uint16_t* cell = body.cell.component(0);
  const Int3 begin = layout.local(box.lo), end = layout.local(box.hi);
  Int3 lo, hi;
  for (int a = 0; a < 3; ++a) {
    lo[a] = std::max<std::int64_t>(begin[a], 0);
    hi[a] = std::min(end[a] + 1, layout.owned()[a]);
  }
  const std::array<std::int64_t, 3> step{1, layout.pitch(), layout.plane()};

  std::vector<FaceQuarter> quarters;
  lattice::for_each(layout, lo, hi, [&](auto i, auto j, auto k, auto n) {
    const SelectedNode node{n, layout.global({i, j, k}), {}, 0};
    if (!box.contains(node.global)) return;
    bool solid = false;
    quarters.clear();
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
          quarters.push_back({n, node.global, a, solid_below ? 1 : -1, {2 * qb + 1, 2 * qc + 1}});
        }
    }
    f(node, solid, quarters);
  });
}

}  // namespace

std::vector<SelectedNode> selected_nodes(const SpringLattice& body, const NodeSet& box) {
  const double quarter = 0.25 * body.grid.d * body.grid.d;
  std::vector<SelectedNode> nodes;
  for_each_selected(body, box, [&](SelectedNode node, bool solid, const std::vector<FaceQuarter>& quarters) {
    if (!solid) return;
    for (const FaceQuarter& part : quarters) {
      node.outward[static_cast<std::size_t>(part.axis)] += part.outward * quarter;
      node.area += quarter;
    }
    nodes.push_back(node);
  });
  return nodes;
}

std::vector<FaceQuarter> selected_quarters(const SpringLattice& body, const NodeSet& box) {
  std::vector<FaceQuarter> all;
  for_each_selected(body, box, [&](const SelectedNode&, bool, const std::vector<FaceQuarter>& quarters) {
    all.insert(all.end(), quarters.begin(), quarters.end());
  });
  return all;
}

}  // namespace koshi::model
