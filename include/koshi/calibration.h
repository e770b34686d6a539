// From elastic constants to springs and back.
//
// Nishimura et al. set entries of the lattice's stiffness tensor (N21), summed over all bonds of a body, equal to those
// of the elastic tensor: `calibrate`. It knows no lattice and takes any set of bonds. The closed forms of theory.md,
// sections 7 and 8, give springs per bond family and a volumetric spring per cell: `springs_for`.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "koshi/lattice.h"
#include "koshi/springs.h"
#include "koshi/vector3.h"

namespace koshi::material {

/// Stiffness tensor C_ijkl with minor and major symmetry, stress = C : strain.
struct ElasticTensor {
  /// [Pa], 6 x 6, rows and columns in the order 11, 22, 33, 23, 13, 12; no factors of 2: voigt[5][5] = C_1212.
  std::array<std::array<double, 6>, 6> voigt{};

  /// C_ijkl [Pa], 0 <= i, j, k, l < 3.
  double operator()(int i, int j, int k, int l) const;
};

/// Errors: InputError unless E > 0 and -1 < nu < 1/2.
void require_elastic_solid(const Elastic& elastic);

/// lambda delta_ij delta_kl + mu (delta_ik delta_jl + delta_il delta_jk).
ElasticTensor elastic_tensor(const Elastic& elastic);

/// Inverse of C for stresses and engineering strains (shear strains count twice) [1/Pa]; nothing when C is singular:
/// some strain meets no resistance.
std::optional<std::array<std::array<double, 6>, 6>> compliance(const ElasticTensor& C);

/// What a stiffness tensor means along the three axes.
struct EngineeringConstants {
  Vec3 youngs_modulus{};  ///< E_i [Pa]
  std::array<std::array<double, 3>, 3>
      poissons_ratio{};    ///< [i][j]: contraction along j under tension along i; 0 if i = j
  Vec3 shear_modulus{};    ///< G_23, G_13, G_12 [Pa]
  double zener_ratio = 0;  ///< 2 C_1212 / (C_1111 - C_1122), means over the axes; 1 for an isotropic lattice
};

/// Nothing when C is singular.
std::optional<EngineeringConstants> engineering_constants(const ElasticTensor& C);

/// Bonds of one direction and length, all with the same stiffness.
struct BondGroup {
  Vec3 D{};          ///< x1 - x2 [m]
  double count = 0;  ///< number of such bonds; a fraction where neighbouring bodies or cells own the rest
  double kn = 0;     ///< [N/m]
  double kt = 0;     ///< [N/m]
};

/// Bonds one cell owns inside the bulk: 1/4 of each edge, 1/2 of each face diagonal, all of each body diagonal, so one
/// group of count 1 per slot; volume d^3. Springs of the families may be left out where only `calibrate` follows.
std::vector<BondGroup> bulk_bonds(lattice::CellType cell, double d, const Springs& springs = {});

/// Bonds of a box of cells, one group per slot. `plain`: every bond counts 1 (Nishimura et al.: 5 x 5 x 9 nodes have
/// 560, 1488, 2000). `shared`: a bond on the surface counts the share its cells own of it. Volume `box_volume`.
std::vector<BondGroup> box_bonds(lattice::CellType cell, Sharing sharing, const Int3& cells, double d,
                                 const Springs& springs = {});
/// d^3 for each cell [m^3].
double box_volume(const Int3& cells, double d);

/// Stiffness tensor of a set of bonds in a volume [m^3] (N21), plus kappa delta_ij delta_kl of volumetric springs.
ElasticTensor lattice_tensor(std::span<const BondGroup> bonds, double volume, double kappa = 0);

/// Stiffness tensor of the unit cell inside the bulk.
ElasticTensor lattice_tensor(const Springs& springs, double d);

/// One stiffness for all bonds.
struct BondStiffness {
  double kn = 0;  ///< [N/m]
  double kt = 0;  ///< [N/m]
};

/// Equations the paper uses (found from its Table 1): Cube-I {"C1111-C1122"}, Cube-II {"C1122", "C1212"},
/// Cube-III {"C1122", "C1111"}.
std::vector<std::string> default_equations(lattice::CellType cell);

/// Errors: InputError when an equation cannot be read; see `calibrate`.
void check_equation(const std::string& equation);

/// The kn, kt for which chosen entries of (N21) equal those of the elastic tensor. Stiffnesses in `bonds` are ignored.
/// `equations`: two linear combinations of entries ("C1122", "C1111 - 2 C1212"), or one, and then kn = kt.
/// `axes`: which body axes are 1, 2, 3 of C; a permutation of "xyz".
/// Errors: InputError for equations that cannot be read, that do not determine the stiffnesses, or that make one
/// negative.
BondStiffness calibrate(std::span<const BondGroup> bonds, double volume, const Elastic& elastic,
                        std::span<const std::string> equations, const std::string& axes = "xyz");

/// The same stiffness for every family the cell has; no volumetric spring.
Springs uniform_springs(lattice::CellType cell, const BondStiffness& stiffness);

/// Springs that give E and nu exactly for -1 < nu < 1/2, by family; theory.md, section 7.
Springs isotropic_springs(lattice::CellType cell, const Elastic& elastic, double d);

/// Springs of Cube-III that also bend and twist with the continuum's energy; theory.md, section 8.
Springs bending_exact_springs(const Elastic& elastic, double d, Kinematics kinematics);

/// The same where positive springs can meet every condition of section 8. Above nu = 0.313 with node rotations they
/// cannot: bending_exact_springs then keep plates exact and twist too stiffly, these keep torsion and the bending of
/// beams exact and bend plates too softly.
Springs beam_exact_springs(const Elastic& elastic, double d, Kinematics kinematics);

/// One of the three closed forms; d [m] the spacing.
/// Errors: InputError for bending-exact and beam-exact springs on a cell other than Cube-III, for E <= 0, nu outside
/// (-1, 1/2) and for the calibration "paper", which needs the bonds of a body (`calibrate`).
Springs springs_for(lattice::CellType cell, Calibration calibration, Kinematics kinematics, const Elastic& elastic,
                    double d);

}  // namespace koshi::material
