// Helpers of check(): errors that know their place.
#pragma once

#include <fmt/format.h>

#include <string>

#include "koshi/definition.h"
#include "model/ranges.h"

namespace koshi::model {

class Checker {
 public:
  explicit Checker(const Definition& checked) : definition(checked) {}

  /// Throws at the place of the key at `path`; without a place, the path stands for it.
  [[noreturn]] void fail(const std::string& path, const std::string& message) const {
    throw InputError(place(path), message);
  }

  /// The last key of the path, for messages.
  static std::string key(const std::string& path) { return path.substr(path.find_last_of('.') + 1); }

  /// Refuses a value that a program filled in; those of a file were looked at when they were read.
  void within(const Range& range, const std::string& path, double value) const {
    if (!range.contains(value)) require(range, key(path), value, place(path));
  }
  void within(const Range& range, const std::string& path, const std::optional<double>& value) const {
    if (value) within(range, path, *value);
  }
  void within(const Range& range, const std::string& path, const Vec3& value) const {
    for (const double component : value) within(range, path, component);
  }
  void ordered(const std::string& path, const Vec3& min, const Vec3& max) const {
    for (std::size_t a = 0; a < 3; ++a)
      if (min[a] > max[a])
        fail(path, fmt::format("min is above max along {} ({:.12g} m and {:.12g} m); exchange them", "xyz"[a], min[a],
                               max[a]));
  }

  const Definition& definition;

 private:
  Place place(const std::string& path) const {
    Place place = definition.places.find(path);
    if (place.file.empty()) place.file = path;
    return place;
  }
};

void check_body(const Checker& check);  ///< lattice, body, materials, regions
/// What breaks a material; `path` of its fracture.
void check_fracture(const Checker& check, const std::string& path, const MaterialDefinition& material);
void check_scan(const Checker& check);         ///< how an image becomes cells
void check_scatter(const Checker& check);      ///< what differs from cell to cell
void check_conditions(const Checker& check);   ///< boundaries, loads, probes
void check_cracks(const Checker& check);       ///< cracks from the start, what ends the run
void check_macroscopic(const Checker& check);  ///< mean strain and stress of a periodic body
void check_run(const Checker& check);          ///< analysis, output

/// Refuses a history whose times do not rise.
void check_history(const Checker& check, const std::string& path, const History& history);
/// Refuses a name that no material has, but "void".
void check_material_name(const Checker& check, const std::string& path, const std::string& material);
/// Refuses a file with a value for each cell, `what` in messages, that is in no known format.
void check_cell_file(const Checker& check, const std::string& path, const std::string& what, const std::string& file);

}  // namespace koshi::model
