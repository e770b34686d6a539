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

}  // namespace koshi::test
