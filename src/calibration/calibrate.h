// `koshi calibrate`: springs from E and nu, and what they really give. No case is needed.
#pragma once

#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "koshi/calibration.h"
#include "koshi/definition.h"
#include "mechanics/self_check.h"

namespace koshi::calibration {

/// Springs of one material and what they give.
struct Calibrated {
  model::LatticeDefinition lattice;  ///< as asked for, defaults filled in (calibration, equations)
  material::Elastic elastic;
  std::optional<Int3> cells;  ///< the body, a box of cells; none: the unit cell inside the bulk
  double bonds = 0;           ///< number of bonds of the body or of the unit cell (shares counted as such)
  material::Springs springs;
  material::ElasticTensor C;                                ///< of the body or of the bulk [Pa]
  std::optional<material::EngineeringConstants> constants;  ///< of C; none when C is singular
  mechanics::SelfCheck check;                               ///< of the springs inside the bulk
  std::string note;  ///< what these springs trade for what, and the choice that does not; empty: nothing to say
};

/// Springs for a material with density > 0, in a box of the given size [m] or, without one, in the unit cell inside the
/// bulk; the size matters to plain springs only.
/// Errors: InputError for elastic constants out of range, a size that is no multiple of the spacing, and whatever
/// `material::springs_for` and `material::calibrate` refuse. Unstable springs are no error here: `check.verdict` says
/// so.
Calibrated calibrate(const model::LatticeDefinition& lattice, const material::Elastic& elastic,
                     const std::optional<Vec3>& size = std::nullopt);

/// What given springs, such as those of a model, give inside the bulk.
Calibrated examine(const model::LatticeDefinition& lattice, const material::Elastic& elastic,
                   const material::Springs& springs);

/// For people: several lines of text, a table each for springs, tensor, elastic constants, self-check and dispersion.
std::string calibration_report(const Calibrated& calibrated);

/// For programs: the same, SI units.
nlohmann::json calibration_json(const Calibrated& calibrated);

/// Table of the dispersion: direction, cells per wavelength, speeds [m/s] and their ratios to the continuum's.
std::string dispersion_csv(const Calibrated& calibrated);

}  // namespace koshi::calibration
