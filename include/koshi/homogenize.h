// Effective elastic stiffness of a body that is periodic in all three directions.
#pragma once

#include <vector>

#include "koshi/calibration.h"
#include "koshi/model.h"
#include "koshi/statics.h"

namespace koshi::homogenize {

/// Bulk and shear modulus [Pa].
struct Moduli {
  double bulk = 0;   ///< K [Pa]
  double shear = 0;  ///< G [Pa]
};

/// What the phases alone say about the moduli of an isotropic mixture.
struct Bounds {
  Moduli voigt;         ///< volume means: no mixture is stiffer
  Moduli reuss;         ///< harmonic means: none is softer; 0 with voids
  Moduli hashin_upper;  ///< Hashin and Shtrikman, Walpole for any number of phases
  Moduli hashin_lower;  ///< 0 with voids
};

/// Share of the box that a material fills.
struct Phase {
  std::uint16_t material = 0;  ///< index as in the cells, 0: void
  double fraction = 0;         ///< of the volume, 0 ... 1
};

/// The effective stiffness and what comes with it.
struct Effective {
  /// Mean stress in load case j, a mean strain of 1 of component j (shear: engineering strain), is column j. [Pa], rows
  /// and columns xx, yy, zz, yz, xz, xy; the symmetric part.
  material::ElasticTensor stiffness;
  double asymmetry = 0;                     ///< largest |C_ij - C_ji| before that, over the largest |C_ij|
  double density = 0;                       ///< mean over the box [kg/m^3]
  std::vector<Phase> phases;                ///< those that are there, by index
  Bounds bounds;                            ///< from the fractions
  std::vector<statics::SolveReport> cases;  ///< of the six solves, in the order of the components
};

/// The isotropic tensor closest to C (least sum of squares over all C_ijkl), and its distance over the size of C.
struct ClosestIsotropic {
  Moduli moduli;        ///< of the closest tensor
  double distance = 0;  ///< 0: C is isotropic
};

/// Six solves with one hierarchy (collective; the same bits on any number of ranks that do not cut the body across x).
/// The model must be periodic in x, y and z, without loads and boundaries, its springs shared: else InputError.
/// RunError when a solve does not converge or was stopped.
Effective effective_stiffness(const model::Model& model, const statics::StaticOptions& options);

/// The same check on a definition alone.
void require_periodic_cell(const model::Definition& definition);

ClosestIsotropic closest_isotropic(const material::ElasticTensor& C);  ///< see ClosestIsotropic

/// Speeds [m/s] of the plane waves along a direction (of any length but 0), the fastest first.
Vec3 wave_speeds(const material::ElasticTensor& C, double density, const Vec3& direction);

}  // namespace koshi::homogenize
