// A block whose bonds break.
#pragma once

#include "support/cases.h"

namespace koshi::test {

/// E 60 GPa, nu 0.2, G_f 100 J/m^2; with isotropic springs, which all belong to bonds.
inline model::Definition block_of_bonds(const Int3& cells, double d) {
  model::Definition definition = block(cells, d, {60e9, 0.2, 2700});
  definition.lattice.calibration = material::Calibration::isotropic;
  material::Fracture& fracture = definition.materials[0].fracture.emplace();
  fracture.law = material::FractureLaw::bonds;
  fracture.fracture_energy = 100;
  return definition;
}

/// A bar of 16 x 2 x 2 of its cells of 5 mm along x, of which the layer from 40 to 45 mm can break; nothing
/// holds it. Its probe is the force at its end.
inline model::Definition bar_with_weak_layer() {
  model::Definition definition = block_of_bonds({16, 2, 2}, 0.005);
  definition.materials.push_back({"weak", definition.materials[0].elastic, definition.materials[0].fracture});
  definition.materials[0].fracture.reset();
  model::RegionDefinition layer;
  layer.material = "weak";
  layer.min = {0.04, 0, 0};
  layer.max = {0.045, 0.01, 0.01};
  definition.regions = {layer};
  definition.probes = {probe("force", model::Face::x_max, model::ProbeDefinition::Quantity::reaction,
                             model::ProbeDefinition::Reduce::sum)};
  return definition;
}

}  // namespace koshi::test
