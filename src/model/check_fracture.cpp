// Checks of what breaks a material, and of whether its lattice can.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "koshi/calibration.h"
#include "model/check.h"
#include "model/choices.h"

namespace koshi::model {
namespace {

// Strength of cells that crack.
void check_cells(const Checker& check, const std::string& path, const material::Fracture& fracture) {
  check.within(ranges::strength, path + ".tensile_strength", fracture.tensile_strength);
  check.within(ranges::strength, path + ".cohesion", fracture.cohesion);
  check.within(ranges::friction_angle, path + ".friction_angle", fracture.friction_angle);
  check.within(ranges::friction_angle, path + ".residual_friction_angle", fracture.residual_friction_angle);
  if (fracture.friction_angle > 0 && !fracture.cohesion)
    check.fail(path + ".friction_angle",
               "friction_angle belongs to a shear strength, but there is no cohesion; give one, such as cohesion = \"8 "
               "MPa\", or leave the angle out");
  // Mohr and Coulomb's line must not cut off the tensile strength that was asked for.
  const double needed =
      fracture.tensile_strength * (1 + std::sin(fracture.friction_angle)) / (2 * std::cos(fracture.friction_angle));
  if (fracture.cohesion && !(*fracture.cohesion > needed))
    check.fail(path + ".cohesion",
               fmt::format("with a cohesion of {:.6g} Pa the material would shear in pure tension below its "
                           "tensile_strength of {:.6g} Pa; the cohesion must be above {:.6g} Pa",
                           *fracture.cohesion, fracture.tensile_strength, needed));
}

// Volumetric spring over mu of the springs that a material gets; they do not depend on the spacing.
double volumetric_spring(const Definition& definition, const material::Elastic& elastic) {
  using material::Calibration;
  const LatticeDefinition& lattice = definition.lattice;
  switch (definition.calibration()) {
    case Calibration::isotropic:
      return material::isotropic_springs(lattice.cell, elastic, 1).kappa / elastic.mu();
    case Calibration::beam_exact:
      return material::beam_exact_springs(elastic, 1, lattice.kinematics).kappa / elastic.mu();
    default:
      return material::bending_exact_springs(elastic, 1, lattice.kinematics).kappa / elastic.mu();
  }
}

// What bonds stand.
void check_limits(const Checker& check, const std::string& path, const material::Fracture& fracture) {
  check.within(ranges::bond_limit, path + ".critical_stretch", fracture.critical_stretch);
  check.within(ranges::bond_limit, path + ".critical_shear", fracture.critical_shear);
}

// Numbers that the law needs; without one those that are there.
void check_numbers(const Checker& check, const std::string& path, const material::Fracture& fracture) {
  using material::FractureLaw;
  const bool cracks = fracture.law != FractureLaw::none;
  if (cracks ? !fracture.critical_stretch : fracture.fracture_energy != 0)
    check.within(ranges::fracture_energy, path + ".fracture_energy", fracture.fracture_energy);
  if (fracture.law != FractureLaw::cohesive) check_limits(check, path, fracture);
  if (cracks ? fracture.law == FractureLaw::cohesive : fracture.tensile_strength != 0)
    check_cells(check, path, fracture);
}

// Bonds that break: the lattice must be bonds and nothing else.
void check_bonds(const Checker& check, const std::string& path, const MaterialDefinition& material) {
  const Definition& definition = check.definition;
  if (definition.lattice.kinematics == material::Kinematics::least_squares)
    check.fail(
        path + ".law",
        "with kinematics \"least-squares\" the bonds of a cell turn with all its corners, so that those on either "
        "side of a crack would turn with the side that moves off; take kinematics = \"rotational\", or law = "
        "\"cohesive\"");
  const double kappa = volumetric_spring(definition, material.elastic);
  if (std::abs(kappa) > 1e-9)
    check.fail(
        path + ".law",
        fmt::format("a cell of these springs has a volumetric spring of {:.3g} mu, which belongs to no bond: with "
                    "all bonds broken it would still pull. law = \"bonds\" needs calibration = \"isotropic\", cell "
                    "= \"cube-II\" or \"cube-III\" and a Poisson's ratio of at most 0.2; or take law = \"cohesive\"",
                    kappa));
  for (const MaterialDefinition& other : definition.materials)
    if (other.cracks() && other.fracture->law != material.fracture->law)
      check.fail(path + ".law",
                 fmt::format("bonds of material \"{}\" break and cells of \"{}\" crack; materials that crack must have "
                             "one law",
                             material.name, other.name));
}

}  // namespace

void check_fracture(const Checker& check, const std::string& path, const MaterialDefinition& material) {
  check_numbers(check, path, *material.fracture);
  if (!material.cracks()) return;

  // Cracks are cells that lose their springs, and the criterion is isotropic.
  const LatticeDefinition& lattice = check.definition.lattice;
  if (lattice.springs != material::Sharing::shared)
    check.fail(path, "fracture takes springs from cells, but plain springs belong to none; use springs = \"shared\"");
  if (check.definition.calibration() == material::Calibration::paper)
    check.fail(path,
               "fracture needs springs that are isotropic, which the paper's calibration does not promise; leave "
               "calibration out, or take \"isotropic\"");
  if (check.definition.analysis.type == AnalysisDefinition::Type::modes)
    check.fail(
        path,
        "type = \"modes\" follows no cracks: modes are small vibrations of the body as it is; use analysis.type = "
        "\"static\", \"quasi-static\" or \"dynamic\", or set law = \"none\"");
  if (material.fracture->law == material::FractureLaw::bonds) check_bonds(check, path, material);
}

}  // namespace koshi::model
