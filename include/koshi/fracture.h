// What it takes to break a material.
#pragma once

#include <cmath>
#include <optional>

#include "koshi/scatter.h"

namespace koshi::material {

/// Whether a material cracks: cells that lose their springs by the energy a crack takes, bonds that break one by one,
/// or never.
enum class FractureLaw { cohesive, bonds, none };

/// How the tensile stress falls as a crack opens: straight to zero, or exponentially.
enum class Softening { linear, exponential };

/// Strength and toughness: a tensile cut-off, with a cohesion also Mohr and Coulomb's limit (theory, section 12). Bonds
/// that break have the fracture energy or the critical stretch, and scatter.
struct Fracture {
  FractureLaw law = FractureLaw::cohesive;       ///< none: the numbers stay, but nothing cracks
  double tensile_strength = 0;                   ///< f_t [Pa], > 0
  double fracture_energy = 0;                    ///< G_f [J/m^2], > 0
  std::optional<double> critical_stretch{};      ///< of a bond's length, > 0; unset: from the fracture energy
  std::optional<double> critical_shear{};        ///< of a bond: shear over length, > 0; unset: none
  std::optional<double> cohesion;                ///< c [Pa], > 0; unset: cracks open in tension only
  double friction_angle = 0;                     ///< phi of the intact material [rad], 0 <= phi < pi/2, with a cohesion
  double residual_friction_angle = 0;            ///< of the crack's faces on each other [rad], 0 <= phi_r < pi/2
  Softening softening = Softening::exponential;  ///< of the cell that cracks
  std::optional<Scatter> strength_scatter{};     ///< of f_t and c, alike, from cell to cell; unset: none

  /// (1 + sin phi)/(1 - sin phi): growth of the compressive strength with the confining pressure.
  double confinement_factor() const { return (1 + std::sin(friction_angle)) / (1 - std::sin(friction_angle)); }
  /// f_c = 2 c cos phi/(1 - sin phi) [Pa], of a free-standing column; 0 without a cohesion, which means no limit.
  double compressive_strength() const {
    return 2 * cohesion.value_or(0) * std::cos(friction_angle) / (1 - std::sin(friction_angle));
  }
  bool operator==(const Fracture&) const = default;
};

}  // namespace koshi::material
