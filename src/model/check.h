// Helpers of check(): errors that know their place.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "koshi/definition.h"

namespace koshi::model {

class Checker {
 public:
  explicit Checker(const Definition& checked) : definition(checked) {}

  /// Throws at the place of the key at `path`; without a place, the path stands for it.
  [[noreturn]] void fail(const std::string& path, const std::string& message) const {
    Place place = definition.places.find(path);
    if (place.file.empty()) place.file = path;
    throw InputError(place, message);
  }

  /// The last key of the path, for messages.
  static std::string key(const std::string& path) { return path.substr(path.find_last_of('.') + 1); }

  void positive(const std::string& path, double value, const std::string& unit) const {
    if (!(value > 0) || !std::isfinite(value))
      fail(path, fmt::format("{} is {:.12g}{}; it must be positive", key(path), value, spaced(unit)));
  }
  void positive(const std::string& path, const std::optional<double>& value, const std::string& unit) const {
    if (value) positive(path, *value, unit);
  }
  void not_negative(const std::string& path, double value, const std::string& unit) const {
    if (!(value >= 0) || !std::isfinite(value))
      fail(path, fmt::format("{} is {:.12g}{}; it must be zero or positive", key(path), value, spaced(unit)));
  }
  void finite(const std::string& path, double value) const {
    if (!std::isfinite(value)) fail(path, fmt::format("{} is {}; it must be finite", key(path), value));
  }
  void finite(const std::string& path, const Vec3& value) const {
    for (const double component : value) finite(path, component);
  }
  void ordered(const std::string& path, const Vec3& min, const Vec3& max) const {
    finite(path, min);
    finite(path, max);
    for (std::size_t a = 0; a < 3; ++a)
      if (min[a] > max[a])
        fail(path, fmt::format("min is above max along {} ({:.12g} m and {:.12g} m); exchange them", "xyz"[a], min[a],
                               max[a]));
  }

  const Definition& definition;

 private:
  static std::string spaced(const std::string& unit) { return unit.empty() ? "" : " " + unit; }
};

void check_body(const Checker& check);        ///< lattice, body, materials, regions
void check_conditions(const Checker& check);  ///< boundaries, loads, probes
void check_run(const Checker& check);         ///< analysis, output

}  // namespace koshi::model
