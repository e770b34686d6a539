#include "model/cut.h"

#include <algorithm>
#include <optional>

#include "model/moments.h"
#include "model/plane_cut.h"
#include "model/regions.h"

namespace koshi::model {
namespace {

// Lengths below this part of a cell are rounding.
constexpr double slack = 1e-9;
// Cubes where two surfaces meet are halved so often, then taken whole by their centre: 1/16 of a cell.
constexpr int most_halvings = 4;

Vec3 corner(const Vec3& centre, double edge, int c) {
  const double h = 0.5 * edge;
  return centre + Vec3{c & 1 ? h : -h, c & 2 ? h : -h, c & 4 ? h : -h};
}

enum class Side { in, out, through };

// Where a cube lies. Primitives are convex: a cube whose corners are inside is inside.
Side side_of(const Primitive& p, const Vec3& centre, double edge) {
  const double at = p.distance(centre), least = slack * edge;
  // Half a diagonal away nothing of the cube is reached.
  if (at > 0.867 * edge) return Side::out;
  if (at < -0.867 * edge) return Side::in;
  double low = p.distance(corner(centre, edge, 0)), high = low;
  for (int c = 1; c < 8; ++c) {
    const double d = p.distance(corner(centre, edge, c));
    low = std::min(low, d);
    high = std::max(high, d);
  }
  if (high <= least) return Side::in;
  if (p.kind == Primitive::Kind::plane && low >= -least) return Side::out;
  return Side::through;
}

// Whether a surface is so flat on the cube that the volume below its flat_cut() is good to about a millionth.
bool flat(const Primitive& p, double edge) { return p.kind == Primitive::Kind::plane || edge <= p.radius / 16; }

// Whether it leaves the planes of flat_cut() in cubes side by side by less than a five-hundredth of a cell's edge d at
// their common face: sagitta edge^2 / (8 radius).
bool flat_at_borders(const Primitive& p, double edge, double d) {
  return p.kind == Primitive::Kind::plane || edge * edge <= 0.016 * p.radius * d;
}

/// The part of a cube where normal . x <= offset, x from its centre in edges.
struct FlatCut {
  Vec3 normal{};
  double offset = 0;
};

// The part inside a surface that is nearly flat: below the plane that fits the distances at the corners, moved to the
// mean distance by Simpson's rule, so that the curvature counts.
FlatCut flat_cut(const Primitive& p, const Vec3& centre, double edge) {
  FlatCut cut;
  double mean = 0;
  for (int c = 0; c < 8; ++c) {
    const double d = p.distance(corner(centre, edge, c));
    mean += d / 8;
    for (int a = 0; a < 3; ++a) cut.normal[static_cast<std::size_t>(a)] += (c >> a & 1 ? d : -d) / 4;
  }
  cut.offset = -(2 * p.distance(centre) + mean) / 3;
  // At the middle of a small ball no plane fits: the cube is whole or empty.
  if (cut.normal == Vec3{}) return {{edge, 0, 0}, p.distance(centre) <= 0 ? edge : -edge};
  return cut;
}

// Whether some of a cube lies inside all primitives; adds those that pass through it.
bool reaches(const std::vector<Primitive>& primitives, const Vec3& centre, double edge,
             std::vector<Primitive>& through) {
  bool out = false;
  for (const Primitive& p : primitives) {
    const Side side = side_of(p, centre, edge);
    out = out || side == Side::out;
    if (side == Side::through) through.push_back(p);
  }
  return !out;
}

}  // namespace

CutBody::CutBody(const Definition& definition, const lattice::Grid& grid) : definition_(definition), grid_(grid) {
  if (definition.body.cells.empty()) material_ = material_index(definition, definition.body.material);
  for (const RegionDefinition& region : definition.regions)
    layers_.push_back({material_index(definition, region.material), primitives_of(region), &region});
}

std::size_t CutBody::index(const Int3& cell) const {
  return static_cast<std::size_t>(cell[0] + grid_.cells[0] * (cell[1] + grid_.cells[1] * cell[2]));
}

std::uint16_t CutBody::background(const Int3& cell) const {
  return definition_.body.cells.empty() ? material_ : definition_.body.cells[index(cell)];
}

bool CutBody::inside(const RegionDefinition& region, const Int3& cell) const {
  const std::size_t at = index(cell);
  return at < region.inside.size() && region.inside[at] != 0;
}

const CutCell* CutBody::cut_cell(const RegionDefinition& region, const Int3& cell) const {
  const auto at = static_cast<std::int64_t>(index(cell));
  const auto found = std::lower_bound(region.cut_cells.begin(), region.cut_cells.end(), at,
                                      [](const CutCell& cut, std::int64_t wanted) { return cut.cell < wanted; });
  return found != region.cut_cells.end() && found->cell == at ? &*found : nullptr;
}

Primitive CutBody::plane_of(const CutCell& cut, const Int3& cell) const {
  const Vec3 centre = grid_.position(cell) + Vec3{0.5 * grid_.d, 0.5 * grid_.d, 0.5 * grid_.d};
  return {Primitive::Kind::plane, centre + (cut.offset * grid_.d) * cut.normal, cut.normal, 0};
}

std::vector<CutBody::Passing> CutBody::passing(const Cube& cube, const Int3& cell) const {
  // From the last layer down to the first that holds the whole cell: what lies below is hidden.
  std::vector<Passing> found;
  for (std::size_t l = layers_.size(); l-- > 0;) {
    const Layer& layer = layers_[l];
    Passing here{layer.material, {}};
    bool missed = false;
    if (layer.region->shape == RegionDefinition::Shape::stl) {
      if (const CutCell* cut = cut_cell(*layer.region, cell))
        here.surfaces.push_back(plane_of(*cut, cell));
      else
        missed = !inside(*layer.region, cell);
    } else {
      missed = !reaches(layer.primitives, cube.centre, cube.edge, here.surfaces);
    }
    if (missed) continue;
    found.push_back(std::move(here));
    if (found.back().surfaces.empty()) break;
  }
  return found;
}

std::vector<CutBody::Passing> CutBody::narrowed(const std::vector<Passing>& layers, const Cube& cube) {
  std::vector<Passing> found;
  for (const Passing& layer : layers) {
    Passing here{layer.material, {}};
    if (!reaches(layer.surfaces, cube.centre, cube.edge, here.surfaces)) continue;
    found.push_back(std::move(here));
    if (found.back().surfaces.empty()) break;
  }
  return found;
}

template <class Flat, class Whole, class Cut>
void CutBody::divide(const Cube& cube, int depth, const std::vector<Passing>& layers, std::uint16_t background,
                     const Flat& flat, const Whole& whole, const Cut& cut) {
  std::size_t surfaces = 0;
  for (const Passing& layer : layers) surfaces += layer.surfaces.size();
  if (surfaces == 0) return whole(layers.empty() ? background : layers.front().material, cube);
  // One surface that is nearly flat: only the first layer can have it, and the one below holds the whole cube.
  const Primitive* only = surfaces == 1 ? &layers.front().surfaces.front() : nullptr;
  if (only != nullptr && (flat(*only, cube.edge) || depth == most_halvings))
    return cut(*only, layers.front().material, layers.size() > 1 ? layers[1].material : background, cube);
  if (depth == most_halvings) {
    const auto holds = [&](const Passing& layer) {
      return std::all_of(layer.surfaces.begin(), layer.surfaces.end(),
                         [&](const Primitive& p) { return p.distance(cube.centre) <= 0; });
    };
    const auto layer = std::find_if(layers.begin(), layers.end(), holds);
    return whole(layer == layers.end() ? background : layer->material, cube);
  }
  for (int c = 0; c < 8; ++c) {
    const Cube part{corner(cube.centre, 0.5 * cube.edge, c), 0.5 * cube.edge};
    divide(part, depth + 1, narrowed(layers, part), background, flat, whole, cut);
  }
}

CellPart CutBody::part_of(const Int3& cell) const {
  const Cube cube{grid_.position(cell) + Vec3{0.5 * grid_.d, 0.5 * grid_.d, 0.5 * grid_.d}, grid_.d};
  const std::vector<Passing> layers = passing(cube, cell);
  const bool whole = layers.empty() || layers.front().surfaces.empty();
  if (whole) {
    const std::uint16_t material = layers.empty() ? background(cell) : layers.front().material;
    return {material, material == 0 ? 0.0 : 1.0, 0};
  }
  std::vector<double> volume(definition_.materials.size() + 1);
  const auto size_of = [this](const Cube& at) { return at.edge * at.edge * at.edge / (grid_.d * grid_.d * grid_.d); };
  divide(
      cube, 0, layers, background(cell), [](const Primitive& p, double edge) { return flat(p, edge); },
      [&](std::uint16_t material, const Cube& at) { volume[material] += size_of(at); },
      [&](const Primitive& p, std::uint16_t in, std::uint16_t out, const Cube& at) {
        const FlatCut plane = flat_cut(p, at.centre, at.edge);
        const double part = part_below(plane.normal, plane.offset);
        volume[in] += part * size_of(at);
        volume[out] += (1 - part) * size_of(at);
      });
  double solid = 0;
  std::uint16_t most = 1;
  for (std::size_t m = 1; m < volume.size(); ++m) {
    solid += volume[m];
    if (volume[m] > volume[most]) most = static_cast<std::uint16_t>(m);
  }
  if (solid < CellPart::least) return {0, 0, solid};
  return {most, solid > 1 - slack ? 1 : solid, 0};
}

Moments CutBody::moments_of(const Int3& cell) const {
  const Cube cube{grid_.position(cell) + Vec3{0.5 * grid_.d, 0.5 * grid_.d, 0.5 * grid_.d}, grid_.d};
  Moments sum{};
  const auto add = [&sum](double sign, const Moments& part) {
    for (std::size_t m = 0; m < sum.size(); ++m) sum[m] += sign * part[m];
  };
  const auto in_cell = [&](const Cube& at) {
    return PartCube{(2 / grid_.d) * (at.centre - cube.centre), at.edge / grid_.d};
  };
  divide(
      cube, 0, passing(cube, cell), background(cell),
      [&](const Primitive& p, double edge) { return flat_at_borders(p, edge, grid_.d); },
      [&](std::uint16_t material, const Cube& at) {
        if (material != 0) add(1, moments_of_cube(in_cell(at)));
      },
      [&](const Primitive& p, std::uint16_t in, std::uint16_t out, const Cube& at) {
        if (in != 0 && out != 0) return add(1, moments_of_cube(in_cell(at)));
        // Of a plane in edges from the cube's centre to one in half edges of the cell.
        const FlatCut plane = flat_cut(p, at.centre, at.edge);
        const PartCube part = in_cell(at);
        const Moments below = moments_below(part, plane.normal, 2 * part.half * plane.offset);
        if (in != 0) return add(1, below);
        if (out == 0) return;
        add(1, moments_of_cube(part));
        add(-1, below);
      });
  return sum;
}

std::uint16_t CutBody::material_at(const Vec3& x, const Int3& cell, int forced, bool holds) const {
  const double least = slack * grid_.d;
  for (std::size_t l = layers_.size(); l-- > 0;) {
    const Layer& layer = layers_[l];
    bool in = holds;
    if (static_cast<int>(l) != forced) {
      if (layer.region->shape == RegionDefinition::Shape::stl) {
        const CutCell* cut = cut_cell(*layer.region, cell);
        in = cut != nullptr ? plane_of(*cut, cell).distance(x) <= least : inside(*layer.region, cell);
      } else {
        in = std::all_of(layer.primitives.begin(), layer.primitives.end(),
                         [&](const Primitive& p) { return p.distance(x) <= least; });
      }
    }
    if (in) return layer.material;
  }
  return background(cell);
}

}  // namespace koshi::model
