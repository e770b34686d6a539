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
};

/// Nodes of a vector.
inline constexpr std::int64_t row_width = 8;

/// Rows start at node i = 0 and are handled in whole vectors; padding holds masses of zero and stays zero.
struct RowUpdate {
  void (*kick)(const Kick& kick, std::int64_t nodes, const double* force, const double* inverse_mass, double* velocity);
  /// u <- u + dt v (N6).
  void (*drift)(double dt, std::int64_t nodes, const double* velocity, double* displacement);
  /// Adds to `given` the work dt (F - F_internal).(v + v')/2 of loads, v and v' the velocities before and after.
  void (*work)(double dt, std::int64_t nodes, const double* force, const double* internal, const double* before,
               const double* after, double* given);
  /// Adds to `damped` what changed the momentum beside the forces: (dt F - m (v' - v)).(v + v')/2.
  void (*damp)(double dt, std::int64_t nodes, const double* force, const double* mass, const double* before,
               const double* after, double* damped);
};

/// Functions for this processor.
const RowUpdate& row_update();

}  // namespace koshi::dynamics
