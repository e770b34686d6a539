// The one table of what a number of the input may be: unit and valid range of each key. The declarations of the keys
// refer to it, and with them the reader, the JSON schema and the reference page; check() refuses by it what a program
// fills in.
#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <string_view>

#include "koshi/error.h"

namespace koshi::model {

/// The values from `least` to `most`; an open end is not among them. Values that are not zero have at least the size
/// `smallest`.
struct Range {
  std::string_view unit{};  ///< SI; empty for plain numbers
  double least = 0, most = 0;
  bool open_below = false, open_above = false;
  double smallest = 0;
  std::string_view reason{};  ///< why, where the ends do not tell; ends the message

  /// False for NaN and infinities.
  constexpr bool contains(double value) const {
    if (!(open_below ? value > least : value >= least)) return false;
    if (!(open_above ? value < most : value <= most)) return false;
    return value == 0 || std::abs(value) >= smallest;
  }
};

/// `lie between 1e-12 m and 1e+09 m`
std::string words(const Range& range);

/// Throws an InputError `NAME is VALUE; it must lie between ...` when the value is outside.
void require(const Range& range, const std::string& name, double value, const Place& place);

/// Ends far beyond any body of matter, and also of bodies in units of their own, yet such that products and squares of
/// them are numbers. The least size of a load or a motion is one whose effect is still computed with all digits.
namespace ranges {

inline constexpr Range symmetric(std::string_view unit, double most, double smallest = 0) {
  return {.unit = unit, .least = -most, .most = most, .smallest = smallest};
}

// Geometry.
inline constexpr Range spacing{.unit = "m", .least = 1e-12, .most = 1e9};
inline constexpr Range size{.unit = "m", .least = 1e-12, .most = 1e12};
inline constexpr Range position = symmetric("m", 1e12);
inline constexpr Range direction = symmetric("", 1e9, 1e-9);

// Images.
inline constexpr Range voxel_count{.least = 1, .most = 1e9};
inline constexpr Range voxel{.least = 0, .most = 1e9};
inline constexpr Range bytes{.least = 0, .most = 2e9};
inline constexpr Range coarsening{.least = 1, .most = 1000};
inline constexpr Range grey = symmetric("", 1e18);
inline constexpr Range scan_density{.unit = "kg/m^3", .least = 0, .most = 1e18};
inline constexpr Range exponent{.least = 0, .most = 10, .open_below = true};

// Materials.
inline constexpr Range youngs_modulus{.unit = "Pa", .least = 1e-9, .most = 1e18};
inline constexpr Range poissons_ratio{.least = -1,
                                      .most = 0.5,
                                      .open_below = true,
                                      .open_above = true,
                                      .reason = "else the shear or the bulk modulus is not positive and finite"};
inline constexpr Range density{.unit = "kg/m^3", .least = 1e-9, .most = 1e18};
inline constexpr Range strength{.unit = "Pa", .least = 1e-9, .most = 1e18};
inline constexpr Range fracture_energy{.unit = "J/m^2", .least = 1e-15, .most = 1e18};
inline constexpr Range bond_limit{.least = 1e-12, .most = 1};
inline constexpr Range friction_angle{.unit = "rad",
                                      .least = 0,
                                      .most = std::numbers::pi / 2,
                                      .open_above = true,
                                      .reason = "an angle below 90 degrees such as \"40 deg\""};

inline constexpr Range weibull_modulus{.least = 1, .most = 1e6};
inline constexpr Range variation{.least = 0,
                                 .most = 0.3,
                                 .open_below = true,
                                 .reason = "so that three standard deviations leave all factors positive"};
inline constexpr Range correlation_length{.unit = "m", .least = 0, .most = 1e12};
inline constexpr Range seed{.least = 0, .most = 2147483647};
inline constexpr Range strength_share{.least = 1e-6, .most = 1e6};

// The run's end.
inline constexpr Range part_of_peak{.least = 0, .most = 1, .open_below = true, .open_above = true};
inline constexpr Range moment{.unit = "s", .least = 0, .most = 1e15};

// Loads and motions.
inline constexpr Range force = symmetric("N", 1e30, 1e-30);
inline constexpr Range pressure = symmetric("Pa", 1e30, 1e-30);
inline constexpr Range acceleration = symmetric("m/s^2", 1e30, 1e-30);
inline constexpr Range displacement = symmetric("m", 1e12, 1e-30);
inline constexpr Range rotation = symmetric("rad", 1e6, 1e-30);
inline constexpr Range velocity = symmetric("m/s", 1e12, 1e-30);
inline constexpr Range angular_velocity = symmetric("rad/s", 1e15, 1e-30);
inline constexpr Range mean_strain = symmetric("", 1e6, 1e-30);
inline constexpr Range factor = symmetric("", 1e15);
inline constexpr Range percentile{.unit = "", .least = 0, .most = 100};
inline constexpr Range ramp{.unit = "s", .least = 0, .most = 1e15};
inline constexpr Range moment_of_history = symmetric("s", 1e15);

// The run.
inline constexpr Range time{.unit = "s", .least = 1e-20, .most = 1e15};
inline constexpr Range tolerance{.least = 1e-15, .most = 1, .open_above = true};
inline constexpr Range safety{.least = 1e-6, .most = 1};
inline constexpr Range damping_factor{.least = 0, .most = 1, .open_above = true};
inline constexpr Range damping_rate{.unit = "1/s", .least = 0, .most = 1e20};
inline constexpr Range event_count{.least = 1, .most = 1e6};
inline constexpr Range mode_count{.least = 1, .most = 200};
inline constexpr Range frequency{.unit = "1/s", .least = 0, .most = 1e20};

}  // namespace ranges
}  // namespace koshi::model
