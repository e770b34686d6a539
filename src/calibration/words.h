// Words shared by the calibration's text and JSON.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "mechanics/self_check.h"

namespace koshi::calibration {

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

}  // namespace koshi::calibration
