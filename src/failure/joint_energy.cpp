#include "failure/joint_energy.h"

#include <cmath>

namespace koshi::failure {

// From the energies of sums and differences; both motions are made alike in size before.
double joint_energy(const model::SpringLattice& body, std::int64_t cell, const mechanics::CellMotion& before,
                    const mechanics::CellMotion& after) {
  const auto square = [](const mechanics::CellMotion& motion) {
    double sum = 0;
    for (const Vec3& u : motion.displacement) sum += dot(u, u);
    return sum;
  };
  const double size = square(after), scale = size > 0 ? std::sqrt(square(before) / size) : 0;
  if (scale == 0) return 0;
  const auto energy = [&](double sign) {
    mechanics::CellMotion motion = before;
    for (std::size_t a = 0; a < 8; ++a) {
      motion.displacement[a] = motion.displacement[a] + (sign * scale) * after.displacement[a];
      motion.rotation[a] = motion.rotation[a] + (sign * scale) * after.rotation[a];
    }
    return mechanics::cell_state(body, motion, cell).energy;
  };
  return (energy(1) - energy(-1)) / (4 * scale * body.factor_of(cell));
}

}  // namespace koshi::failure
