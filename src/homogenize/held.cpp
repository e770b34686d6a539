#include "homogenize/held.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/exact_sum.h"
#include "koshi/error.h"

namespace koshi::homogenize {
namespace {

// Components held on the faces across axis `face`, a bit each. Mixed boundaries are planes of mirrors: what changes its
// sign in the mirror is zero on it.
unsigned held_on(Boundary boundary, std::size_t j, std::size_t face) {
  if (boundary == Boundary::displacement) return 0b111'111;
  unsigned held = 0;
  const auto [a, b] = tensor_axes[j];
  // The mirror keeps a mean strain, or turns the sign of a shear across it.
  const bool kept = a == b || (face != a && face != b);
  for (std::size_t c = 0; c < 3; ++c) {
    const bool along = c == face;
    if (along == kept) held |= 1u << c;        // displacements: vectors
    if (along != kept) held |= 1u << (3 + c);  // rotations: axial vectors
  }
  return held;
}

// Calls f(face axis, +1 or -1, local node, index, part of the area of a cell's face) for each owned node on each of the
// six faces that it lies on.
template <class F>
void for_each_surface_node(const model::Model& model, F&& f) {
  const lattice::Layout& layout = model.layout();
  const Int3& n = model.lattice.grid.cells;
  lattice::for_each_owned(layout, [&](auto i, auto j, auto k, auto index) {
    const Int3 local{i, j, k}, global = layout.global(local);
    for (std::size_t a = 0; a < 3; ++a) {
      if (global[a] != 0 && global[a] != n[a]) continue;
      double area = 1;
      for (const std::size_t b : {(a + 1) % 3, (a + 2) % 3}) area *= global[b] == 0 || global[b] == n[b] ? 0.5 : 1;
      f(a, global[a] == 0 ? -1 : 1, local, index, area);
    }
  });
}

}  // namespace

std::vector<std::vector<std::size_t>> groups_of_cases(Boundary boundary) {
  if (boundary == Boundary::mixed) return {{0, 1, 2}, {3}, {4}, {5}};
  return {{0, 1, 2, 3, 4, 5}};
}

void hold_surface(Boundary boundary, const std::vector<std::size_t>& cases, model::Model& model) {
  model.motions.clear();
  // The uniform strain is added to what is solved for, so that held components of that are zero. Motions name the
  // boundary that they belong to.
  model.definition.boundaries = {model::BoundaryDefinition{}};
  if (boundary == Boundary::displacement || boundary == Boundary::mixed) {
    std::vector<std::pair<std::int64_t, unsigned>> held;
    for_each_surface_node(model, [&](std::size_t a, int, const Int3&, std::int64_t index, double) {
      if (model.inertia.component(0)[index] == 0) return;
      const unsigned here = held_on(boundary, cases.front(), a);
      if (!held.empty() && held.back().first == index)
        held.back().second |= here;
      else
        held.emplace_back(index, here);
    });
    for (const auto& [node, components] : held)
      for (int c = 0; c < model.components(); ++c)
        if ((components >> c & 1u) != 0) model.motions.push_back({node, static_cast<std::int8_t>(c), false, 0, 0});
  }
  model.motion_count = model.communicator.sum(static_cast<std::int64_t>(model.motions.size()));
}

void surface_forces(const model::Model& model, std::size_t j, double* right_hand_side) {
  const Int3& owned = model.layout().owned();
  const std::int64_t count = model.layout().owned_count();
  const double face = model.lattice.grid.d * model.lattice.grid.d;
  std::fill_n(right_hand_side, count * model.components(), 0.0);
  const auto [a, b] = tensor_axes[j];
  for_each_surface_node(model, [&](std::size_t axis, int sign, const Int3& node, std::int64_t, double area) {
    const std::int64_t number = node[0] + owned[0] * (node[1] + owned[1] * node[2]);
    // t_a = Sigma_ab n_b, and t_b = Sigma_ab n_a.
    const auto push = [&](std::size_t component) {
      right_hand_side[static_cast<std::int64_t>(component) * count + number] += sign * area * face;
    };
    if (axis == b) push(a);
    if (axis == a && a != b) push(b);
  });
}

mechanics::Tensor6 surface_strain(const model::Model& model, const lattice::Field<double>& u) {
  std::array<ExactSum, 6> sums;
  for_each_surface_node(model, [&](std::size_t axis, int sign, const Int3&, std::int64_t index, double area) {
    for (std::size_t v = 0; v < 6; ++v) {
      const auto [a, b] = tensor_axes[v];
      if (axis == b) sums[v] += 0.5 * sign * area * u.component(static_cast<int>(a))[index];
      if (axis == a) sums[v] += 0.5 * sign * area * u.component(static_cast<int>(b))[index];
    }
  });
  sum_ranks(sums, model.communicator);
  mechanics::Tensor6 mean;
  // Areas in d^2 over a volume in d^3.
  const double scale = 1 / (static_cast<double>(model.lattice.grid.cell_count()) * model.lattice.grid.d);
  for (std::size_t v = 0; v < 6; ++v) mean[v] = scale * sums[v].value();
  return mean;
}

void require_whole_surface(const model::Model& model) {
  const lattice::Layout& layout = model.layout();
  const Int3& n = model.lattice.grid.cells;
  std::int64_t voids = 0;
  lattice::for_each_owned(layout, [&](auto i, auto j, auto k, auto index) {
    const Int3 cell = layout.global({i, j, k});
    bool inside = true, border = false;
    for (std::size_t a = 0; a < 3; ++a) {
      inside = inside && cell[a] < n[a];
      border = border || cell[a] == 0 || cell[a] == n[a] - 1;
    }
    voids += inside && border && model.lattice.cell.component(0)[index] == 0;
  });
  voids = model.communicator.sum(voids);
  if (voids == 0) return;
  throw InputError(model.definition.places.find("body"),
                   fmt::format("{} void cells lie on the surface, where no traction can act; fill them with a soft "
                               "material, or take the boundary \"periodic\", \"mixed\" or \"displacement\"",
                               voids));
}

}  // namespace koshi::homogenize
