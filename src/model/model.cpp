#include "koshi/model.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "base/collective.h"
#include "koshi/calibration.h"
#include "lattice/halo.h"
#include "model/conditions.h"
#include "model/regions.h"

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

// Mass and rotational inertia of the nodes: each cell gives an eighth of its mass and volume to its corners; the
// inertia is that of a sphere of the node's volume, J = 2/5 m R^2 (N24).
lattice::Field<double> make_inertia(const Model& model) {
  const lattice::Layout& layout = model.layout();
  const bool rotational = model.components() == 6;
  lattice::Field<double> inertia(layout, rotational ? 2 : 1);
  const std::uint8_t* cell = model.lattice.cell.component(0);
  const double eighth = std::pow(model.lattice.grid.d, 3) / 8;
  lattice::for_each_owned(layout, [&](auto, auto, auto, auto n) {
    double mass = 0;
    int cells = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const std::uint8_t m = cell[n - layout.offset({corner & 1, corner >> 1 & 1, corner >> 2})];
      if (m == 0) continue;
      ++cells;
      mass += model.materials[m].density * eighth;
    }
    inertia.component(0)[n] = mass;
    if (rotational) {
      const double R = std::cbrt(3 * cells * eighth / (4 * std::numbers::pi));
      inertia.component(1)[n] = 0.4 * mass * R * R;
    }
  });
  return inertia;
}

double available_memory() {
  std::ifstream file("/proc/meminfo");
  std::string key;
  double kilobytes = 0;
  while (file >> key) {
    if (key == "MemAvailable:" && file >> kilobytes) return 1024 * kilobytes;
    file.ignore(256, '\n');
  }
  return std::numeric_limits<double>::infinity();
}

void check_memory(const Definition& definition) {
  const double needed = predicted_memory(definition), available = available_memory();
  if (needed <= available) return;
  const double spacing = definition.lattice.spacing * std::cbrt(needed / available);
  throw InputError(
      definition.places.find("lattice.spacing"),
      fmt::format("the run needs {:.3g} GB of memory and {:.3g} GB are free; a spacing of about {:.3g} m would fit",
                  needed / 1e9, available / 1e9, 1.02 * spacing));
}

}  // namespace

double predicted_memory(const Definition& definition) {
  const Int3 cells = make_grid(definition).cells;
  const double padded = static_cast<double>((cells[0] + 1 + 2 * lattice::Layout::lead) * (cells[1] + 3)) *
                        static_cast<double>(cells[2] + 3);
  const int components = definition.lattice.kinematics == material::Kinematics::rotational ? 6 : 3;
  // Displacement, velocity and force, two inertias, the cell and its bonds.
  return padded * (8.0 * (3 * components + 2) + 1 + lattice::slot_count);
}

Model make_model(const Definition& definition, const Communicator& communicator) {
  check(definition);
  const lattice::Grid grid = make_grid(definition);
  collectively(communicator, [&] { check_memory(definition); });
  const auto partition = std::make_shared<const lattice::Partition>(lattice::make_partition(grid, communicator.size()));
  const auto halo = std::make_shared<const lattice::Halo>(grid, *partition, communicator);

  Model model{definition, communicator, {}, make_cells(grid, partition, halo, material_of_cells(definition, grid)),
              {},         {},           {}, {}};
  model.materials.resize(1);
  for (const MaterialDefinition& m : definition.materials) model.materials.push_back(m.elastic);
  std::array<std::int64_t, 2> counts{};
  const std::uint8_t* cell = model.lattice.cell.component(0);
  lattice::for_each_owned(model.layout(), [&](auto, auto, auto, auto n) { counts[0] += cell[n] != 0; });
  model.cell_count = communicator.sum(counts[0]);
  if (model.cell_count == 0)
    throw InputError(definition.places.find("body"),
                     "the body has no solid cell; give it a material, or make the void smaller");

  collectively(communicator, [&] {
    make_bonds(model.lattice, definition.lattice.springs, definition.lattice.kinematics,
               make_springs(definition, model.lattice, model.volume()));
  });
  model.inertia = make_inertia(model);
  lattice::for_each_owned(model.layout(),
                          [&](auto, auto, auto, auto n) { counts[1] += model.inertia.component(0)[n] > 0; });
  model.node_count = communicator.sum(counts[1]);
  model.motions = make_motions(model);
  model.motion_count = communicator.sum(static_cast<std::int64_t>(model.motions.size()));
  model.loads = make_loads(model);
  model.probes = make_probes(model);
  return model;
}

}  // namespace koshi::model
