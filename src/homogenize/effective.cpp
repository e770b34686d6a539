#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/exact_sum.h"
#include "homogenize/bounds.h"
#include "koshi/error.h"
#include "statics/static_solver.h"
#include "statics/uniform_strain.h"

namespace koshi::homogenize {
namespace {

// Residual that rounding leaves where the strain is uniform: displacements E x of n cells have an error of n ulps, and
// the springs of a cell turn them into forces of their own stiffness.
double rounding_residual(const model::Model& model) {
  double most = 0;
  for (const material::Elastic& elastic : model.materials)
    most = std::max(most, elastic.youngs_modulus > 0 ? elastic.lambda() + 2 * elastic.mu() : 0.0);
  const model::SpringLattice& body = model.lattice;
  const auto cells = static_cast<double>(*std::max_element(body.grid.cells.begin(), body.grid.cells.end()));
  const double d = body.grid.d;
  return 1e-15 * cells * most * d * d * std::sqrt(static_cast<double>(model.node_count * model.components()));
}

// Volumes of the materials, and the mean density.
void count_phases(const model::Model& model, Effective& effective) {
  const model::SpringLattice& body = model.lattice;
  std::vector<std::int64_t> count(model.materials.size());
  lattice::for_each_owned(body.layout, [&](auto, auto, auto, auto n) { ++count[body.cell.component(0)[n]]; });
  // The masses of the nodes are those of their cells, partly filled ones too.
  ExactSum mass;
  lattice::for_each_owned(body.layout, [&](auto, auto, auto, auto n) { mass += model.inertia.component(0)[n]; });
  mass.sum_ranks(model.communicator);
  model.communicator.sum(count);
  const auto cells = static_cast<double>(body.grid.cell_count());
  for (std::size_t m = 0; m < count.size(); ++m) {
    if (count[m] == 0) continue;
    const double fraction = static_cast<double>(count[m]) / cells;
    effective.phases.push_back({static_cast<std::uint16_t>(m), fraction});
  }
  effective.density = mass.value() / (cells * std::pow(body.grid.d, 3));
}

}  // namespace

void require_periodic_cell(const model::Definition& definition) {
  const model::Places& places = definition.places;
  for (std::size_t a = 0; a < 3; ++a)
    if (!definition.body.periodic[a])
      throw InputError(places.find("body.periodic"),
                       fmt::format("the body is not periodic in {}, but its effective stiffness is that of a body "
                                   "repeated in all directions; set periodic = [\"x\", \"y\", \"z\"] in [body]",
                                   "xyz"[a]));
  if (!definition.boundaries.empty())
    throw InputError(places.find("boundary[0]"),
                     "the six load cases of an effective stiffness are mean strains, and nothing else holds the body; "
                     "remove the boundaries");
  if (!definition.loads.empty())
    throw InputError(places.find("load[0]"),
                     "the six load cases of an effective stiffness are mean strains; remove the loads");
  if (definition.lattice.springs == material::Sharing::plain)
    throw InputError(places.find("lattice.springs"),
                     "plain springs belong to no cell, so that stress has no mean over cells of several materials; "
                     "set springs = \"shared\"");
}

Effective effective_stiffness(const model::Model& model, const statics::StaticOptions& options) {
  require_periodic_cell(model.definition);
  Effective effective;
  count_phases(model, effective);
  effective.bounds = find_bounds(model);

  lattice::Field<double> u(model.layout(), model.components());
  std::vector<double> right_hand_side(static_cast<std::size_t>(model.layout().owned_count() * model.components()));
  statics::StaticSolver solver(model, 0, u, options);
  const double rounding = rounding_residual(model);
  material::ElasticTensor whole;
  for (std::size_t j = 0; j < 6; ++j) {
    mechanics::Tensor6 strain{};
    strain[j] = j < 3 ? 1 : 0.5;
    // The springs push the uniform strain out of balance; the periodic part restores it.
    u.zero();
    statics::add_uniform_strain(model, strain, u);
    solver.equilibrium().right_hand_side(u, right_hand_side.data());
    effective.cases.push_back(solver.solve(right_hand_side.data(), rounding, u));
    if (effective.cases.back().stopped) throw RunError("stopped before the six load cases were solved");
    statics::add_uniform_strain(model, strain, u);
    const mechanics::Tensor6 stress = statics::mean_stress(model, u);
    for (std::size_t i = 0; i < 6; ++i) whole.voigt[i][j] = stress[i];
  }

  double largest = 0, difference = 0;
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j) {
      largest = std::max(largest, std::abs(whole.voigt[i][j]));
      difference = std::max(difference, std::abs(whole.voigt[i][j] - whole.voigt[j][i]));
      effective.stiffness.voigt[i][j] = (whole.voigt[i][j] + whole.voigt[j][i]) / 2;
    }
  effective.asymmetry = largest > 0 ? difference / largest : 0;
  return effective;
}

}  // namespace koshi::homogenize
