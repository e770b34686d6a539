// What strength and toughness a lattice gives: a block of eight cells strained evenly until it breaks.
#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

#include "koshi/definition.h"

namespace koshi::driver {

/// Uniaxial tension and compression along one direction.
struct StrengthTest {
  std::string name;                 ///< "[110]"
  Vec3 direction{};                 ///< unit vector
  double tensile_strength = 0;      ///< stress at which cells crack [Pa]
  double fracture_energy = 0;       ///< that a crack across the direction takes [J/m^2]
  double compressive_strength = 0;  ///< of a free-standing column [Pa]; 0 for a material without cohesion
};

struct StrengthReport {
  material::Fracture asked;
  double spacing = 0;                ///< d [m]
  std::vector<StrengthTest> tests;   ///< [100], [110], [111]
  double characteristic_length = 0;  ///< E G_f/f_t^2 [m]
  double spacing_limit = 0;          ///< below it every direction has both strength and energy [m]
};

/// Errors: InputError for a lattice or fracture that model::check() refuses.
StrengthReport test_strength(const model::LatticeDefinition& lattice, const material::Elastic& elastic,
                             const material::Fracture& fracture);

/// A table for the terminal.
std::string strength_text(const StrengthReport& report);
/// The same for programs, in SI units.
nlohmann::ordered_json strength_json(const StrengthReport& report);

}  // namespace koshi::driver
