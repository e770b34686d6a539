// Words shared by the calibration's text and JSON; they are those of the input file.
#pragma once

#include <array>
#include <string_view>

#include "mechanics/self_check.h"

namespace koshi::driver {

constexpr std::string_view name(material::Calibration calibration) {
  constexpr std::array<std::string_view, 3> names{"bending-exact", "isotropic", "paper"};
  return names[static_cast<std::size_t>(calibration)];
}

constexpr std::string_view name(material::Sharing sharing) {
  return sharing == material::Sharing::shared ? "shared" : "plain";
}

constexpr std::string_view name(material::Kinematics kinematics) {
  return kinematics == material::Kinematics::rotational ? "rotational" : "least-squares";
}

constexpr std::string_view name(mechanics::Verdict verdict) {
  constexpr std::array<std::string_view, 3> names{"ok", "warning", "refused"};
  return names[static_cast<std::size_t>(verdict)];
}

/// "[110]"
inline std::string direction_name(const Vec3& direction) {
  std::string text = "[";
  for (const double component : direction) text += component != 0 ? '1' : '0';
  return text + "]";
}

inline constexpr std::array<std::string_view, lattice::family_count> family_names{"edge", "face", "body"};
inline constexpr std::array<std::string_view, 3> axis_names{"x", "y", "z"};

}  // namespace koshi::driver
