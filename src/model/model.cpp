#include "koshi/model.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "base/collective.h"
#include "base/exact_sum.h"
#include "koshi/calibration.h"
#include "lattice/halo.h"
#include "model/conditions.h"
#include "model/cut.h"
#include "model/memory.h"
#include "model/pre_cracks.h"
#include "model/regions.h"
#include "model/scatter.h"
#include "model/surface_supports.h"

namespace koshi::model {
namespace {

// Springs of every material. The paper's calibration sums over the bonds of the whole body, the closed forms know only
// the cell.
std::vector<material::Springs> make_springs(const Definition& definition, const SpringLattice& body, double volume) {
  const LatticeDefinition& lattice = definition.lattice;
  std::vector<material::Springs> springs(1);
  if (definition.calibration() != material::Calibration::paper) {
    for (const MaterialDefinition& m : definition.materials)
      springs.push_back(material::springs_for(lattice.cell, definition.calibration(), lattice.kinematics, m.elastic,
                                              lattice.spacing));
    return springs;
  }
  const auto counts = count_bonds(body, lattice.springs);
  auto bonds = material::bulk_bonds(lattice.cell, lattice.spacing);
  for (std::size_t slot = 0; slot < bonds.size(); ++slot) bonds[slot].count = counts[slot];
  const auto equations = lattice.equations.empty() ? material::default_equations(lattice.cell) : lattice.equations;
  for (const MaterialDefinition& m : definition.materials)
    springs.push_back(material::uniform_springs(
        lattice.cell, material::calibrate(bonds, volume, m.elastic, equations, lattice.axes)));
  return springs;
}

// Springs and bonds know no input file: what they find wrong is put down to a place here.
template <class F>
void at_place(const Place& place, F&& action) {
  try {
    action();
  } catch (const InputError& error) {
    throw InputError(place, error.message());
  }
}

// Mass and rotational inertia of the nodes: each cell gives an eighth of its mass and volume to its corners; the
// inertia is that of a sphere of the node's volume, J = 2/5 m R^2 (N24).
lattice::Field<double> make_inertia(const Model& model) {
  const lattice::Layout& layout = model.layout();
  const bool rotational = model.components() == 6;
  lattice::Field<double> inertia(layout, rotational ? 2 : 1);
  const std::uint16_t* cell = model.lattice.cell.component(0);
  const double eighth = std::pow(model.lattice.grid.d, 3) / 8;
  const auto share_of = density_share_of_cells(model.definition, model.lattice.grid);
  lattice::for_each_owned(layout, [&](auto i, auto j, auto k, auto n) {
    // Of a cut cell only the part inside has mass, in equal shares for all corners: mass and stiffness then shrink
    // alike, and the stable step stays. So the radius keeps to whole cells.
    double mass = 0;
    int cells = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const std::array<int, 3> back{corner & 1, corner >> 1 & 1, corner >> 2};
      const std::int64_t at = n - layout.offset(back);
      const std::uint16_t m = cell[at];
      if (m == 0) continue;
      ++cells;
      const double share = share_of ? share_of(layout.global({i - back[0], j - back[1], k - back[2]})) : 1;
      mass += share * model.lattice.fraction_of(at) * model.materials[m].density * eighth;
    }
    inertia.component(0)[n] = mass;
    if (rotational) {
      const double R = std::cbrt(3 * cells * eighth / (4 * std::numbers::pi));
      inertia.component(1)[n] = 0.4 * mass * R * R;
    }
  });
  return inertia;
}

// What surfaces made of the cells of all ranks.
CutCells count_cut_cells(const Model& model) {
  const CutBody body(model.definition, model.lattice.grid);
  ExactSum volume, left_out;
  std::int64_t count = 0;
  lattice::for_each_owned(model.layout(), [&](auto i, auto j, auto k, auto n) {
    const double fraction = model.lattice.fraction_of(n);
    if (model.lattice.cell.component(0)[n] != 0) volume += fraction;
    count += fraction > 0 && fraction < 1;
    const Int3 cell = model.layout().global({i, j, k});
    for (int a = 0; a < 3; ++a)
      if (cell[a] >= model.lattice.grid.cells[a]) return;
    left_out += body.part_of(cell).left_out;
  });
  volume.sum_ranks(model.communicator);
  left_out.sum_ranks(model.communicator);
  return {model.communicator.sum(count), volume.value(), left_out.value()};
}

}  // namespace

Model make_model(const Definition& definition, const Communicator& communicator) {
  check(definition);
  const lattice::Grid grid = make_grid(definition);
  collectively(communicator, [&] { check_memory(definition, communicator.size()); });
  const auto partition = std::make_shared<const lattice::Partition>(lattice::make_partition(grid, communicator.size()));
  const auto halo = std::make_shared<const lattice::Halo>(grid, *partition, communicator);

  Model model{definition, communicator,
              {},         make_cells(grid, partition, halo, material_of_cells(definition, grid)),
              {},         {},
              {},         {},
              {},         0,
              0,          0,
              {}};
  if (const auto fraction_of = fraction_of_cells(definition, grid)) {
    make_fractions(model.lattice, fraction_of);
    make_surface(model.lattice, moments_of_cells(definition, grid));
  }
  if (const auto factor_of = factor_of_cells(definition, grid)) make_factors(model.lattice, factor_of);
  scatter_stiffness(definition, model.lattice);
  collectively(communicator, [&] { model.strength = strength_of_cells(definition, model.lattice); });
  model.materials.resize(1);
  for (const MaterialDefinition& m : definition.materials) model.materials.push_back(m.elastic);
  std::array<std::int64_t, 2> counts{};
  const std::uint16_t* cell = model.lattice.cell.component(0);
  lattice::for_each_owned(model.layout(), [&](auto, auto, auto, auto n) { counts[0] += cell[n] != 0; });
  model.cell_count = communicator.sum(counts[0]);
  if (model.cell_count == 0)
    throw InputError(definition.places.find("body"),
                     "the body has no solid cell; give it a material, or make the void smaller");

  if (definition.cuts()) model.cut = count_cut_cells(model);
  std::vector<material::Springs> springs;
  collectively(communicator, [&] {
    at_place(definition.places.find("lattice.calibration"),
             [&] { springs = make_springs(definition, model.lattice, model.volume()); });
  });
  set_springs(model.lattice, definition.lattice.springs, definition.lattice.kinematics, std::move(springs));
  model.inertia = make_inertia(model);
  lattice::for_each_owned(model.layout(),
                          [&](auto, auto, auto, auto n) { counts[1] += model.inertia.component(0)[n] > 0; });
  model.node_count = communicator.sum(counts[1]);
  model.motions = make_motions(model);
  model.motion_count = communicator.sum(static_cast<std::int64_t>(model.motions.size()));
  collectively(communicator, [&] { model.lattice.ground = make_supports(model); });
  model.loads = make_loads(model);
  model.probes = make_probes(model);
  check_pre_cracks(model);
  return model;
}

State::State(const Model& model)
    : displacement(model.layout(), model.components()), velocity(model.layout(), model.components()) {
  if (!model.definition.cracks()) return;
  crack = lattice::Field<double>(model.layout(), crack_components);
  work = lattice::Field<double>(model.layout(), 2);
  const bool by_bonds = model.definition.breaks_bonds();
  face_force = lattice::Field<double>(model.layout(), by_bonds ? model.components() : 3);
  if (by_bonds) {
    bonds = lattice::Field<double>(model.layout(), 2);
    break_bonds(model, bonds);
  } else {
    add_cracks(model, crack);
  }
}

}  // namespace koshi::model
