// What given springs really give: elastic constants, bending and torsion, stability, wave speeds. Results are returned.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "koshi/calibration.h"
#include "koshi/springs.h"
#include "mechanics/dispersion.h"

namespace koshi::mechanics {

/// Energy of one cell over the continuum's for the displacement fields of theory.md, section 8; 1 = exact, above 1 the
/// lattice bends or twists too stiffly where it is a few cells thick. With rotational kinematics every corner turns by
/// half the curl of the field, (0, b z, -a y) or (x, -y/2, -z/2): section 8 is built on this choice, which neighbouring
/// cells agree on; the rotation that would make one lone cell softest gives less.
struct EnergyRatios {
  double bending = 0;  ///< u = ((a y^2 + b z^2)/2, -a x y, -b x z) with b = 0: E/(1 - nu^2)/24 (a^2 + b^2 + 2 nu a b)
  double dome_bending = 0;    ///< the same with b = a
  double saddle_bending = 0;  ///< the same with b = -a; equal to dome_bending where the Poisson coupling is exact
  double beam_bending = 0;    ///< the least over b: a beam, whose section curls freely; E/24 a^2
  double torsion = 0;         ///< u = (0, -z x, y x): mu/12
};

/// Springs of Cube-I, -II or -III; kinematics as used; E and nu the springs stand for.
EnergyRatios energy_ratios(const material::Springs& springs, double d, material::Kinematics kinematics,
                           const material::Elastic& elastic);

/// Eigenvalues of one isolated cell in units of mu d, rotations measured in units of 1/d (so lengths drop out).
struct CellModes {
  double least = 0;                 ///< the smallest eigenvalue; negative: unstable, else 0 up to rounding
  double smallest_nonzero = 0;      ///< the smallest eigenvalue above zero
  int zero_modes_beyond_rigid = 0;  ///< zero eigenvalues besides the six rigid-body motions
};
CellModes cell_modes(const material::Springs& springs, double d, material::Kinematics kinematics,
                     material::Sharing sharing, double mu);

enum class Verdict { ok, warning, refuse };

struct SelfCheck {
  material::ElasticTensor target;  ///< of the elastic solid
  material::ElasticTensor C;       ///< of the lattice in the bulk (springs shared or plain alike)
  double C_error = 0;              ///< largest |C - target| over largest |target|
  std::optional<material::EngineeringConstants> constants;  ///< E, nu, G, Zener ratio of C; none when C is singular
  EnergyRatios energy;
  CellModes cell;
  ZoneScan zone;
  std::vector<DispersionRow> dispersion;
  double bulk_step = 0;  ///< stable step 2/omega_max of the infinite lattice [s]

  Verdict verdict = Verdict::ok;
  std::string reason;  ///< what is wrong; empty when ok
  std::string remedy;  ///< what to choose instead; empty when ok
};

/// Checks springs meant for an elastic solid (density > 0: speeds and steps need it), d [m].
/// - refuse: some motion of a cell or a wave releases energy (unstable), or a motion other than a rigid one costs none.
/// - warning: only rotations are loose, as the checkerboard ("gear") mode of Cube-I with node rotations, in which nodes
///   turn against their neighbours; displacements and forces are not affected.
SelfCheck self_check(const material::Springs& springs, double d, material::Kinematics kinematics,
                     material::Sharing sharing, const material::Elastic& elastic);

}  // namespace koshi::mechanics
