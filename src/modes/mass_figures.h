// Masses that take part in a mode.
#pragma once

#include <array>

#include "koshi/modes.h"
#include "modes/vibration.h"

namespace koshi::modes {

/// The six motions of the body as a whole about its centre of mass, on the components that can move.
class MassFigures {
 public:
  MassFigures(const model::Model& model, Vibration& vibration);

  const Vec3& centre() const { return centre_; }
  /// r.M r of each motion r, and the part of it in the free motions [kg], [kg m^2].
  const std::array<double, 6>& total() const { return total_; }
  const std::array<double, 6>& rigid() const { return rigid_; }
  /// Fills a mode's shape and masses from its vector of unit length (collective).
  void measure(const double* y, Mode& mode) const;

 private:
  const model::Model& model_;
  const Vibration& vibration_;
  Vec3 centre_{};
  std::array<double, 6> total_{}, rigid_{};
};

}  // namespace koshi::modes
