// The update of one row in an explicit step, compiled for several instruction sets like mechanics/cell_strip.h.
#pragma once

#include <cstddef>
#include <cstdint>

namespace koshi::dynamics {

/// v <- keep v + gain (F - alpha |F| sign(v)) / m: central differences (N5) with local (N27) and viscous (N1) damping.
struct Kick {
  double keep;   ///< (1 - c dt/2) / (1 + c dt/2)
  double gain;   ///< dt / (1 + c dt/2) [s]
  double alpha;  ///< local damping factor

  /// c dt/2 of viscous damping.
  double drag() const { return (1 - keep) / (1 + keep); }
};

/// Nodes of a vector.
inline constexpr std::int64_t row_width = 8;

/// Rows start at node i = 0 and are handled in whole vectors; padding holds masses of zero and stays zero.
struct RowUpdate {
  void (*kick)(const Kick& kick, std::int64_t nodes, const double* force, const double* inverse_mass, double* velocity);
  /// The same, and adds to `damped` what damping takes on the way, its force times dt (v + v')/2, v and v' the
  /// velocities before and after. `mass` is read by viscous damping alone.
  void (*kick_and_count)(const Kick& kick, double dt, std::int64_t nodes, const double* force,
                         const double* inverse_mass, const double* mass, double* velocity, double* damped);
  /// u <- u + dt v (N6).
  void (*drift)(double dt, std::int64_t nodes, const double* velocity, double* displacement);
  /// Adds to `given` the work dt (F - F_internal).(v + v')/2 of loads, v and v' the velocities before and after.
  void (*work)(double dt, std::int64_t nodes, const double* force, const double* internal, const double* before,
               const double* after, double* given);
};

/// Functions for this processor.
const RowUpdate& row_update();

}  // namespace koshi::dynamics
