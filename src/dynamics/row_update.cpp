// Compiled once per instruction set with KOSHI_ISA set to its name.
#include "dynamics/row_update.h"

namespace koshi::dynamics::KOSHI_ISA {
namespace {

void kick(const Kick& k, std::int64_t nodes, const double* __restrict force, const double* __restrict inverse_mass,
          double* __restrict velocity) {
  const double keep = k.keep, gain = k.gain, alpha = k.alpha;
  for (std::int64_t begin = 0; begin < nodes; begin += row_width) {
    for (std::int64_t i = begin; i < begin + row_width; ++i) {
      const double F = force[i], v = velocity[i];
      const double resisting = alpha * (F < 0 ? -F : F);
      const double damped = F - (v > 0 ? resisting : v < 0 ? -resisting : 0.0);
      velocity[i] = keep * v + gain * (damped * inverse_mass[i]);
    }
  }
}

template <bool viscous>
void count_kick(const Kick& k, double dt, std::int64_t nodes, const double* __restrict force,
                const double* __restrict inverse_mass, const double* __restrict mass, double* __restrict velocity,
                double* __restrict damped) {
  const double keep = k.keep, gain = k.gain, alpha = k.alpha, drag = viscous ? k.drag() : 0;
  for (std::int64_t begin = 0; begin < nodes; begin += row_width) {
    for (std::int64_t i = begin; i < begin + row_width; ++i) {
      const double F = force[i], v = velocity[i];
      const double resisting = alpha * (F < 0 ? -F : F);
      const double against = v > 0 ? resisting : v < 0 ? -resisting : 0.0;
      const double next = keep * v + gain * ((F - against) * inverse_mass[i]);
      velocity[i] = next;
      const double lost = viscous ? drag * mass[i] * (v + next) : dt * against;
      damped[i] += lost * (0.5 * (v + next));
    }
  }
}

void kick_and_count(const Kick& k, double dt, std::int64_t nodes, const double* force, const double* inverse_mass,
                    const double* mass, double* velocity, double* damped) {
  (k.keep != 1 ? count_kick<true> : count_kick<false>)(k, dt, nodes, force, inverse_mass, mass, velocity, damped);
}

void drift(double dt, std::int64_t nodes, const double* __restrict velocity, double* __restrict displacement) {
  for (std::int64_t begin = 0; begin < nodes; begin += row_width)
    for (std::int64_t i = begin; i < begin + row_width; ++i) displacement[i] += dt * velocity[i];
}

void work(double dt, std::int64_t nodes, const double* __restrict force, const double* __restrict internal,
          const double* __restrict before, const double* __restrict after, double* __restrict given) {
  const double half = 0.5 * dt;
  for (std::int64_t begin = 0; begin < nodes; begin += row_width)
    for (std::int64_t i = begin; i < begin + row_width; ++i)
      given[i] += (force[i] - internal[i]) * (half * (before[i] + after[i]));
}

}  // namespace

extern const RowUpdate functions{kick, kick_and_count, drift, work};

}  // namespace koshi::dynamics::KOSHI_ISA
