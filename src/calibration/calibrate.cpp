#include "calibration/calibrate.h"

#include <fmt/format.h>

#include "koshi/error.h"
#include "model/ranges.h"
#include "model/regions.h"

namespace koshi::calibration {
namespace {

model::LatticeDefinition with_defaults(const model::LatticeDefinition& lattice) {
  model::Definition definition;
  definition.lattice = lattice;
  definition.lattice.calibration = definition.calibration();
  if (definition.lattice.calibration == material::Calibration::paper && definition.lattice.equations.empty())
    definition.lattice.equations = material::default_equations(lattice.cell);
  return definition.lattice;
}

/// Bonds and volume of the body, or of the unit cell inside the bulk.
struct Bonds {
  std::vector<material::BondGroup> groups;
  double volume;
};

Bonds bonds_of(const model::LatticeDefinition& lattice, const std::optional<Int3>& cells,
               const material::Springs& springs) {
  const double d = lattice.spacing;
  if (!cells) return {material::bulk_bonds(lattice.cell, d, springs), d * d * d};
  return {material::box_bonds(lattice.cell, lattice.springs, *cells, d, springs), material::box_volume(*cells, d)};
}

/// Above nu = 0.302 springs with node rotations cannot meet all conditions of theory.md, section 8.
std::string note(const Calibrated& found) {
  const mechanics::EnergyRatios& energy = found.check.energy;
  if (found.lattice.calibration == material::Calibration::bending_exact && energy.torsion > 1.001)
    return fmt::format(
        "bars a few cells thick twist too stiffly ({:+.0f} % for a cell); calibration \"beam-exact\" twists exactly, "
        "kinematics \"least-squares\" bends and twists exactly",
        100 * (energy.torsion - 1));
  if (found.lattice.calibration == material::Calibration::beam_exact && energy.bending < 0.999)
    return fmt::format(
        "plates a few cells thick bend too softly ({:+.0f} % for a cell); calibration \"bending-exact\" bends them "
        "exactly, kinematics \"least-squares\" bends and twists exactly",
        100 * (energy.bending - 1));
  return {};
}

Calibrated examine_body(const model::LatticeDefinition& lattice, const material::Elastic& elastic,
                        const std::optional<Int3>& cells, const material::Springs& springs) {
  Calibrated found{lattice, elastic, cells, 0, springs, {}, {}, {}, {}};
  const Bonds bonds = bonds_of(lattice, cells, springs);
  for (const material::BondGroup& group : bonds.groups) found.bonds += group.count;
  found.C = material::lattice_tensor(bonds.groups, bonds.volume, springs.kappa);
  found.constants = material::engineering_constants(found.C);
  found.check = mechanics::self_check(springs, lattice.spacing, lattice.kinematics, lattice.springs, elastic);
  found.note = note(found);
  return found;
}

}  // namespace

Calibrated calibrate(const model::LatticeDefinition& asked, const material::Elastic& elastic,
                     const std::optional<Vec3>& size) {
  const model::LatticeDefinition lattice = with_defaults(asked);
  model::require(model::ranges::spacing, "spacing", lattice.spacing, {});
  model::require(model::ranges::density, "density", elastic.density, {});
  model::require(model::ranges::youngs_modulus, "Young's modulus", elastic.youngs_modulus, {});
  model::require(model::ranges::poissons_ratio, "Poisson's ratio", elastic.poissons_ratio, {});
  if (lattice.calibration != material::Calibration::paper && (!lattice.equations.empty() || lattice.axes != "xyz"))
    throw InputError("equations and axes are for calibration \"paper\"; drop them or choose it");
  std::optional<Int3> cells;
  if (size) {
    model::Definition body;
    body.lattice = lattice;
    body.body.size = *size;
    cells = model::make_grid(body).cells;
  }

  material::Springs springs;
  if (lattice.calibration == material::Calibration::paper) {
    const Bonds bonds = bonds_of(lattice, cells, {});
    springs = material::uniform_springs(
        lattice.cell, material::calibrate(bonds.groups, bonds.volume, elastic, lattice.equations, lattice.axes));
  } else {
    springs = material::springs_for(lattice.cell, *lattice.calibration, lattice.kinematics, elastic, lattice.spacing);
  }
  return examine_body(lattice, elastic, cells, springs);
}

Calibrated examine(const model::LatticeDefinition& lattice, const material::Elastic& elastic,
                   const material::Springs& springs) {
  return examine_body(with_defaults(lattice), elastic, std::nullopt, springs);
}

}  // namespace koshi::calibration
