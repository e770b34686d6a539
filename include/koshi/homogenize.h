// Effective elastic stiffness of a box: repeated in all directions, or between plates.
#pragma once

#include <array>
#include <optional>
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

/// What is done at the faces of the box in a load case.
enum class Boundary {
  periodic,      ///< the box is repeated
  displacement,  ///< all nodes of the surface follow the mean strain (KUBC): no stiffness is larger
  traction,      ///< the surface carries the forces of a uniform stress (SUBC): none is smaller; no voids on it
  mixed          ///< smooth plates: as if mirror images of the box were put beside it
};

/// What fills the box.
struct Structure {
  double porosity = 0;            ///< share of void cells
  double connected_porosity = 0;  ///< of those in pores that lead from one side of the box to the opposite one; cells
                                  ///< of a pore share faces
  Vec3 through{};                 ///< of those in pores that lead through along x, y, z
  double specific_surface = 0;    ///< area of the faces between solid and void over the volume of the box [1/m]
  std::int64_t islands = 0;       ///< parts of the solid beside the largest; cells of a part share nodes
  double island_fraction = 0;     ///< share of the box that they fill
};

/// Means over the cells of a material: row i of column j is component i under a mean strain of 1 of component j
/// (shear: engineering strain).
struct PhaseMeans {
  std::uint16_t material = 0;                     ///< index as in the cells, not 0
  std::array<std::array<double, 6>, 6> stress{};  ///< [Pa]
  std::array<std::array<double, 6>, 6> strain{};  ///< engineering shear strains
};

/// The effective stiffness and what comes with it.
struct Effective {
  Boundary boundary = Boundary::periodic;  ///< of the six cases
  /// Mean stress in load case j, a mean strain of 1 of component j (shear: engineering strain), is column j. [Pa], rows
  /// and columns xx, yy, zz, yz, xz, xy; the symmetric part.
  material::ElasticTensor stiffness;
  double asymmetry = 0;                     ///< largest |C_ij - C_ji| before that, over the largest |C_ij|
  double density = 0;                       ///< mean over the box [kg/m^3]
  std::vector<Phase> phases;                ///< those that are there, by index
  std::vector<PhaseMeans> means;            ///< of the solid phases; empty for more than 100
  Structure structure;                      ///< pores and parts
  Bounds bounds;                            ///< from the fractions
  std::vector<statics::SolveReport> cases;  ///< of the six solves, in the order of the components
};

/// The isotropic tensor closest to C (least sum of squares over all C_ijkl), and its distance over the size of C.
struct ClosestIsotropic {
  Moduli moduli;        ///< of the closest tensor
  double distance = 0;  ///< 0: C is isotropic
};

/// A tensor of higher symmetry, closest over all orientations, in its own axes; the distance as in ClosestIsotropic.
struct Closest {
  material::ElasticTensor tensor;  ///< [Pa] in its own axes
  std::array<Vec3, 3> axes{};      ///< unit vectors; transversely isotropic about the third
  double distance = 0;             ///< 0: C has this symmetry
};

/// Six solves (collective; the same bits on any number of ranks that do not cut the body across x), with one hierarchy
/// but for mixed boundaries, which need four. The model must have no loads and boundaries and shared springs; it must
/// be periodic in x, y and z for Boundary::periodic, and in none else: else InputError. RunError when a solve does not
/// converge or was stopped.
Effective effective_stiffness(const model::Model& model, const statics::StaticOptions& options,
                              Boundary boundary = Boundary::periodic);

/// The same check on a definition alone.
void require_loadable_cell(const model::Definition& definition, Boundary boundary);

ClosestIsotropic closest_isotropic(const material::ElasticTensor& C);  ///< see ClosestIsotropic

Closest closest_cubic(const material::ElasticTensor& C);       ///< of the symmetry of a cube
Closest closest_transverse(const material::ElasticTensor& C);  ///< isotropic about one axis

/// 5 G_Voigt / G_Reuss + K_Voigt / K_Reuss - 6 of a polycrystal with this C (Ranganathan and Ostoja-Starzewski 2008,
/// Phys. Rev. Lett. 101, 055504); 0: isotropic; nothing when C is singular.
std::optional<double> universal_anisotropy(const material::ElasticTensor& C);

}  // namespace koshi::homogenize
