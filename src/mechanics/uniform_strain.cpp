#include "mechanics/uniform_strain.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/exact_sum.h"
#include "lattice/halo.h"

namespace koshi::mechanics {
namespace {

std::array<Vec3, 3> rows_of(const Tensor6& strain) {
  const auto& [xx, yy, zz, yz, xz, xy] = strain;
  return {Vec3{xx, xy, xz}, Vec3{xy, yy, yz}, Vec3{xz, yz, zz}};
}

Vec3 times(const std::array<Vec3, 3>& rows, const Vec3& x) {
  return {dot(rows[0], x), dot(rows[1], x), dot(rows[2], x)};
}

// Global numbers, so that all ranks give a node the same displacement.
Vec3 distance(const model::Model& model, const Int3& node) {
  const double d = model.lattice.grid.d;
  return {d * static_cast<double>(node[0]), d * static_cast<double>(node[1]), d * static_cast<double>(node[2])};
}

}  // namespace

Vec3 uniform_displacement(const model::Model& model, const Tensor6& strain, const Int3& node) {
  return times(rows_of(strain), distance(model, node));
}

void add_uniform_strain(const model::Model& model, const Tensor6& strain, lattice::Field<double>& u) {
  if (strain == Tensor6{}) return;
  const std::array<Vec3, 3> rows = rows_of(strain);
  const lattice::Layout& layout = model.layout();
  const Int3& owned = layout.owned();
  lattice::for_each(layout, {-1, -1, -1}, {owned[0] + 1, owned[1] + 1, owned[2] + 1},
                    [&](auto i, auto j, auto k, auto n) {
                      const Vec3 added = times(rows, distance(model, layout.global({i, j, k})));
                      for (int c = 0; c < 3; ++c) u.component(c)[n] += added[static_cast<std::size_t>(c)];
                    });
}

Tensor6 given_strain(const model::Definition& definition, double time) {
  const model::MacroscopicDefinition& asked = *definition.macroscopic;
  const double factor = model::factor(asked.history, time);
  Tensor6 strain;
  for (std::size_t c = 0; c < 6; ++c) strain[c] = factor * asked.strain_of(c).value_or(0);
  return strain;
}

bool has_mean_strain(const model::Model& model, std::size_t c) {
  const auto& periodic = model.lattice.grid.periodic;
  return periodic[tensor_axes[c][0]] && periodic[tensor_axes[c][1]];
}

void exchange_displacements(const model::Model& model, const Tensor6& strain, lattice::Field<double>& u) {
  model.lattice.halo->exchange(u);
  add_periods(model, strain, u);
}

void add_periods(const model::Model& model, const Tensor6& strain, lattice::Field<double>& u) {
  if (strain == Tensor6{}) return;
  const std::array<Vec3, 3> rows = rows_of(strain);
  const lattice::Layout& layout = model.layout();
  const lattice::Grid& grid = model.lattice.grid;
  const Int3& owned = layout.owned();
  // Periods from a ghost's original to the ghost: -1, 0 or 1 along each axis.
  const auto periods = [&](const Int3& node) {
    Int3 count{};
    for (std::size_t a = 0; a < 3; ++a)
      if (grid.periodic[a]) count[a] = node[a] < 0 ? -1 : node[a] >= grid.cells[a] ? 1 : 0;
    return count;
  };
  const auto visit = [&](std::int64_t first, std::int64_t last, std::int64_t j, std::int64_t k) {
    lattice::for_each(layout, {first, j, k}, {last, j + 1, k + 1}, [&](auto i, auto, auto, auto n) {
      const Int3 count = periods(layout.global({i, j, k}));
      if (count == Int3{}) return;
      const Vec3 jump =
          times(rows, distance(model, {count[0] * grid.cells[0], count[1] * grid.cells[1], count[2] * grid.cells[2]}));
      for (int c = 0; c < 3; ++c) u.component(c)[n] += jump[static_cast<std::size_t>(c)];
    });
  };
  for (std::int64_t k = -1; k <= owned[2]; ++k)
    for (std::int64_t j = -1; j <= owned[1]; ++j) {
      const bool ghosts = j < 0 || k < 0 || j == owned[1] || k == owned[2];
      // Of a row of owned nodes the two ends alone are ghosts.
      visit(-1, ghosts ? owned[0] + 1 : 0, j, k);
      if (!ghosts) visit(owned[0], owned[0] + 1, j, k);
    }
}

Tensor6 mean_stress(const model::Model& model, const lattice::Field<double>& u) {
  const model::SpringLattice& body = model.lattice;
  std::array<ExactSum, 6> sums;
  lattice::for_each_owned(body.layout, [&](auto, auto, auto, auto n) {
    if (body.cell.component(0)[n] == 0) return;
    const Tensor6 stress = cell_state(body, u, n).stress;
    for (std::size_t v = 0; v < 6; ++v) sums[v] += stress[v];
  });
  sum_ranks(sums, model.communicator);
  Tensor6 mean;
  for (std::size_t v = 0; v < 6; ++v) mean[v] = sums[v].value() / static_cast<double>(body.grid.cell_count());
  return mean;
}

double rounding_residual(const model::Model& model) {
  // Displacements E x of n cells have an error of n ulps, and the springs of a cell turn them into forces of their own
  // stiffness.
  double most = 0;
  for (const material::Elastic& elastic : model.materials)
    most = std::max(most, elastic.youngs_modulus > 0 ? elastic.lambda() + 2 * elastic.mu() : 0.0);
  const model::SpringLattice& body = model.lattice;
  const auto cells = static_cast<double>(*std::max_element(body.grid.cells.begin(), body.grid.cells.end()));
  const double d = body.grid.d;
  return 1e-15 * cells * most * d * d * std::sqrt(static_cast<double>(model.node_count * model.components()));
}

}  // namespace koshi::mechanics
