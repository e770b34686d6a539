// Elastic constants and the springs that stand for them.
#pragma once

#include <array>
#include <cmath>

#include "koshi/lattice.h"

namespace koshi::material {

/// Where the rotation of the bond law comes from (theory, section 2): three rotations per node, or the cell's
/// least-squares fit.
enum class Kinematics { rotational, least_squares };

/// Springs belong to cells, which share their bonds, or every bond carries its full stiffness (theory, section 6).
enum class Sharing { shared, plain };

/// How E and nu become springs: theory, sections 8 (two of them), 7 and 3.
enum class Calibration { bending_exact, beam_exact, isotropic, paper };

/// Isotropic elastic solid; E in Pa (> 0), -1 < nu < 1/2, density in kg/m^3 (> 0).
struct Elastic {
  double youngs_modulus = 0;  ///< E [Pa]
  double poissons_ratio = 0;  ///< nu
  double density = 0;         ///< rho [kg/m^3]

  /// Lamé's [Pa].
  double lambda() const { return youngs_modulus * poissons_ratio / ((1 + poissons_ratio) * (1 - 2 * poissons_ratio)); }
  double mu() const { return youngs_modulus / (2 * (1 + poissons_ratio)); }  ///< Lamé's [Pa]

  /// Speed of compression waves [m/s].
  double p_wave_speed() const { return std::sqrt((lambda() + 2 * mu()) / density); }
  double s_wave_speed() const { return std::sqrt(mu() / density); }  ///< [m/s]

  bool operator==(const Elastic&) const = default;
};

/// Springs of one material, by bond family: the full stiffness of a bond inside the bulk, and the volumetric modulus.
/// With shared springs a cell owns 1/4 of an edge, 1/2 of a face diagonal, all of a body diagonal (theory, section 6).
struct Springs {
  std::array<double, lattice::family_count> kn{};  ///< normal stiffness [N/m]
  std::array<double, lattice::family_count> kt{};  ///< shear stiffness [N/m]
  double kappa = 0;                                ///< volumetric spring per cell [Pa], energy 1/2 kappa d^3 theta^2
};

}  // namespace koshi::material
