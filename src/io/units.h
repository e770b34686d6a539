// Quantities with units, through UDUNITS-2.
#pragma once

#include <string>
#include <string_view>

#include "koshi/error.h"

namespace koshi::io {

/// What a key of the input measures. An angle is its own dimension here: rad/s and 1/s are told apart.
enum class Dimension {
  number,
  length,
  time,
  pressure,
  density,
  force,
  acceleration,
  velocity,
  angle,
  angular_velocity,
  rate,
  energy_per_area
};

struct DimensionWords {
  std::string_view noun;     ///< "a length"
  std::string_view si_unit;  ///< "m"; empty for plain numbers
  std::string_view example;  ///< "0.2 cm"
};

const DimensionWords& words(Dimension dimension);

/// `a length such as "0.2 cm" (a bare number is in m)`
std::string expected_quantity(Dimension dimension);

/// SI value of a quantity such as "0.2 cm", "1112 MPa", "9.8 N" or "10 deg"; a bare number is SI.
/// Decimal conversions round once: "1.8 cm" is the double nearest to 0.018.
/// Errors: InputError at `place` for text that is no number, is not finite, or has an unknown unit or a unit of another
/// dimension; the message names the expected dimension and shows a right value.
double parse_quantity(std::string_view text, Dimension dimension, const Place& place);

}  // namespace koshi::io
