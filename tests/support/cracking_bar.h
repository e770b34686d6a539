// A bar with one layer that can crack, and a static run that follows it.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "driver/simulation.h"
#include "support/cases.h"

namespace koshi::test {

inline const material::Elastic cracking_concrete{30e9, 0.2, 2400};

// A bar of 80 mm x 10 mm x 10 mm along x of which only one layer of cells can crack, at 3 MPa for 100 J/m^2, pulled
// between smooth platens.
inline model::Definition cracking_bar(double d, material::Kinematics kinematics, material::Softening softening) {
  model::Definition definition =
      block({std::llround(0.08 / d), std::llround(0.01 / d), std::llround(0.01 / d)}, d, cracking_concrete);
  definition.materials.push_back({"weak", cracking_concrete, material::Fracture{}});
  material::Fracture& fracture = *definition.materials[1].fracture;
  fracture.tensile_strength = 3e6;
  fracture.fracture_energy = 100;
  fracture.softening = softening;
  model::RegionDefinition layer;
  layer.material = "weak";
  layer.min = {0.04, 0, 0};
  layer.max = {0.04 + d, 0.01, 0.01};
  definition.regions = {layer};
  model::BoundaryDefinition pull = fixed("pull", model::Face::x_max, {});
  pull.displacement[0] = 1e-4;
  model::BoundaryDefinition point = fixed("point", model::Face::x_min, {1, 2});
  point.selection = {};
  point.selection.point = Vec3{0, 0, 0};
  model::BoundaryDefinition edge = point;
  edge.name = "edge";
  edge.selection.point = Vec3{0, 0.01, 0};
  edge.fix[1] = false;
  definition.boundaries = {fixed("wall", model::Face::x_min, {0}), pull, point, edge};
  definition.lattice.kinematics = kinematics;
  if (kinematics == material::Kinematics::rotational)  // smooth platens turn no node
    for (std::size_t b : {0u, 1u}) definition.boundaries[b].fix[4] = definition.boundaries[b].fix[5] = true;
  definition.probes = {probe("force", model::Face::x_max, model::ProbeDefinition::Quantity::reaction,
                             model::ProbeDefinition::Reduce::sum)};
  definition.analysis = {};
  definition.analysis.type = model::AnalysisDefinition::Type::statics;
  definition.analysis.tolerance = 1e-9;
  return definition;
}

// The same under this traction [Pa] on its end, times the history, without probes.
inline model::Definition loaded_bar(material::Softening softening, double traction, const model::History& history) {
  model::Definition definition = cracking_bar(0.005, material::Kinematics::least_squares, softening);
  definition.boundaries.erase(definition.boundaries.begin() + 1);
  model::LoadDefinition load;
  load.name = "pull";
  load.selection.face = model::Face::x_max;
  load.traction = Vec3{traction, 0, 0};
  load.history = history;
  definition.loads = {load};
  definition.probes.clear();
  return definition;
}

struct CrackRow {
  double time, factor, force;
  mechanics::Balance balance;
};

struct Followed {
  std::vector<CrackRow> rows;
  driver::Outcome outcome;
};

inline Followed follow_cracks(const model::Definition& definition) {
  driver::Simulation simulation(definition, Communicator::world());
  Followed followed;
  driver::Observer observer;
  observer.history = [&](const mechanics::Measurement& at, model::State& state) {
    if (definition.follows_events()) EXPECT_EQ(state.time, static_cast<double>(followed.rows.size()));
    followed.rows.push_back({state.time, at.balance.load_factor, at.probes.empty() ? 0 : at.probes[0][0], at.balance});
  };
  followed.outcome = simulation.run(observer);
  return followed;
}

// Elastic energy and what cracks took are the work of loads and supports; the largest gap over the work at the end.
inline double energy_gap(const Followed& followed) {
  double largest = 0;
  for (const CrackRow& row : followed.rows)
    largest = std::max(largest, std::abs(row.balance.elastic_energy + row.balance.cracked - row.balance.given));
  return largest / followed.rows.back().balance.given;
}

}  // namespace koshi::test
