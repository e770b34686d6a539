// Formulas of the input, in x, y, z and t.
#pragma once

#include <memory>
#include <string>

#include "koshi/vector3.h"

namespace koshi::model {

/// A formula such as "max(0, 10 - z)", read once and evaluated often. Its parser is muParser.
class Formula {
 public:
  /// Errors: InputError without a place that says at which character the text goes wrong.
  explicit Formula(const std::string& text);
  ~Formula();
  Formula(Formula&&) noexcept;
  Formula& operator=(Formula&&) noexcept;

  /// The value at a place [m] and a time [s]; not finite where the formula is not.
  double at(const Vec3& place, double t) const;
  /// Whether t stands in it.
  bool varies_in_time() const;

  static constexpr std::size_t longest = 1000;  ///< characters

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace koshi::model
