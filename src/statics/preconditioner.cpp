#include "statics/preconditioner.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "statics/cell_springs.h"

namespace koshi::statics {
namespace {

// What the preconditioner takes for each material. Edges alone leave node rotations a checkerboard that costs nothing,
// and coarse levels would fall for it: face diagonals with a tenth of their shear stiffness hold it.
std::vector<CellConstants> preconditioner_constants(const model::SpringLattice& body) {
  std::vector<CellConstants> by_material;
  for (const material::Springs& springs : body.springs) {
    CellConstants& k = by_material.emplace_back(mechanics::springs_of_cell(springs, body.grid.d));
    if (body.components() == 6 && springs.kt[1] == 0 && springs.kt[2] == 0) k[3] = 0.1 * k[1];
  }
  return by_material;
}

// The largest constant: over it all are about 1, and single precision serves any unit.
double largest_of(const std::vector<CellConstants>& by_material) {
  double largest = 0;
  for (const CellConstants& constants : by_material)
    for (const double k : constants) largest = std::max(largest, std::abs(k));
  return largest;
}

// Constants of all cells.
RowField<float> fine_constants(const model::SpringLattice& body, const std::vector<CellConstants>& by_material,
                               double largest) {
  RowField<float> constants(body.layout.owned(), mechanics::cell_constants);
  const std::uint16_t* const cell = body.cell.component(0);
  lattice::for_each(body.layout, {-1, -1, -1}, body.layout.owned(), [&](auto i, auto j, auto k, auto n) {
    if (cell[n] == 0) return;
    for (int q = 0; q < mechanics::cell_constants; ++q)
      constants.row(j, k)[q * constants.pitch() + i] =
          static_cast<float>(body.factor_of(n) * by_material[cell[n]][q] / largest);
  });
  return constants;
}

// Fixed nodes, and those that the ground holds. A spring at a place between nodes becomes one at each of them:
// (sum_a N_a e_a)^2 <= sum_b |N_b| sum_a |N_a| e_a^2, so the body of the levels is held no less than it is, and the
// bound of the relaxation stays. `largest`: the stiffness that the levels take for 1.
FixedNodes held_nodes(const model::SpringLattice& body, const FixedNodes& fixed, double largest) {
  if (body.ground.empty()) return fixed;
  std::map<std::array<std::int64_t, 3>, FixedNode> held;  // in memory order
  const auto at = [&](const Int3& node) -> FixedNode& {
    FixedNode& there = held[{node[2], node[1], node[0]}];
    there.node = node;
    return there;
  };
  for (const FixedNode& node : fixed) at(node.node).mask = node.mask;
  const auto& layout = body.layout;
  for (const model::GroundSpring& spring : body.ground) {
    const Int3 cell = layout.place(spring.cell);
    double sum = 0;
    for (const double weight : spring.weights) sum += std::abs(weight);
    for (std::size_t a = 0; a < 8; ++a) {
      Int3 node = cell;
      for (std::size_t axis = 0; axis < 3; ++axis) node[axis] += a >> axis & 1;
      if (!layout.owns(node)) continue;
      const double k = spring.stiffness * sum * std::abs(spring.weights[a]) / largest;
      FixedNode& there = at(node);
      for (std::size_t s = 0; s < 6; ++s)
        there.spring[s] +=
            static_cast<float>(k * spring.direction[tensor_axes[s][0]] * spring.direction[tensor_axes[s][1]]);
    }
  }
  FixedNodes list;
  for (const auto& [place, node] : held) list.push_back(node);
  return list;
}

}  // namespace

Preconditioner::Preconditioner(const model::Model& model, const FixedNodes& fixed, const FreeMotions& free)
    : components_(model.components()), free_(free) {
  const model::SpringLattice& body = model.lattice;
  const auto by_material = preconditioner_constants(body);
  CycleOptions options;
  for (std::size_t m = 1; m < by_material.size(); ++m)
    options.bound = std::max(options.bound, relaxation_bound(by_material[m], components_));
  options.shift = free.count() > 0 ? 1e-8 : 0;
  const double largest = unit_ = largest_of(by_material);
  const LevelGrid grid{body.grid, body.partition, body.halo};
  const auto constants = [&] { return fine_constants(body, by_material, largest); };
  const FixedNodes held = held_nodes(body, fixed, largest);
  if (body.fraction.components() != 0) {
    surface_ = std::make_unique<SurfaceTerms>(body, 1 / largest);
    options.surface = surface_.get();
    // A cell's own bound would be far too high where little of it is inside.
    constexpr int steps = 40;
    constexpr double margin = 1.1;
    const double stretch = Level(grid, components_, constants(), held, surface_.get()).stretch(steps);
    options.bound = std::max(options.bound, margin * stretch);
  }
  // Nearly incompressible springs have a wide spectrum that the relaxation must cover.
  options.degree = options.bound < 4 ? 3 : options.bound < 6 ? 4 : 5;
  // A body of a few cells across bends at little cost, and coarse cells take it for stiffer than it is.
  constexpr std::int64_t thin = 3;
  if (*std::ranges::min_element(body.grid.cells) <= thin) options.degree = 5;
  hierarchy_ = std::make_unique<Hierarchy>(grid, components_, constants(), held, options);
}

template <class T, class F>
void Preconditioner::for_each_row(RowField<float>& field, T* unknowns, F&& copy) const {
  const Int3& n = field.owned();
  for (int c = 0; c < components_; ++c)
    for (std::int64_t k = 0; k < n[2]; ++k)
      for (std::int64_t j = 0; j < n[1]; ++j, unknowns += n[0])
        copy(field.row(j, k) + c * field.pitch(), unknowns, n[0]);
}

void Preconditioner::cycle() {
  hierarchy_->cycle();
  free_.project(hierarchy_->finest().x);
}

void Preconditioner::apply(const double* r, double* z) {
  Level& level = hierarchy_->finest();
  for_each_row(level.b, r, [](float* to, const double* from, std::int64_t count) {
    for (std::int64_t i = 0; i < count; ++i) to[i] = static_cast<float>(from[i]);
  });
  hierarchy_->cycle();
  for_each_row(level.x, z, [](const float* from, double* to, std::int64_t count) {
    for (std::int64_t i = 0; i < count; ++i) to[i] = from[i];
  });
  free_.project(z);
}

}  // namespace koshi::statics
