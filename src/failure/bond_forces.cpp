// What broken bonds change in forces and energies: whole bonds are in the cell kernel, so that what a broken one would
// carry is taken off, but for the pressure of one that is shortened.
#include "failure/bond_breaking.h"
#include "failure/cell_bond_forces.h"

namespace koshi::failure {
// Of central differences: half of K times the displacements before and after the step (theory, 12.7), but for what the
// closed bond keeps.
double BondBreaking::energy_lost(std::int64_t n, std::uint32_t bonds, double dt) const {
  const mechanics::CellMotion now = mechanics::cell_motion(model_.lattice, state_.displacement, n);
  const mechanics::CellMotion rate = mechanics::cell_motion(model_.lattice, state_.velocity, n);
  double sum = 0;
  for_each_bond(model_.lattice, n, bonds,
                [&](const mechanics::CellBond& bond, const Vec3& D, const mechanics::Stiffness& k) {
                  const Vec3 r = relative(now, bond, D), before = r - dt * relative(rate, bond, D);
                  sum += 0.5 * dot(before, mechanics::bond_force(dot(r, D) < 0 ? 0 : k.kn, k.kt, D, r));
                });
  return sum;
}

// No quadratic form belongs to a bond that closes or opens in the step: of r_n f_{n+1}/2 and r_{n+1} f_n/2, which are
// one for a spring, one vanishes. Closing takes some energy and opening gives some, both with the square of the step.
double BondBreaking::closing_loss(std::int64_t n, double dt) const {
  const auto now = mechanics::cell_motion(model_.lattice, state_.displacement, n).displacement;
  const auto rate = mechanics::cell_motion(model_.lattice, state_.velocity, n).displacement;
  double sum = 0;
  for_each_bond(model_.lattice, n, broken_before(n),
                [&](const mechanics::CellBond& bond, const Vec3& D, const mechanics::Stiffness& k) {
                  const auto a = static_cast<std::size_t>(bond.a), b = static_cast<std::size_t>(bond.b);
                  const double length = dot(now[a] - now[b], D), before = length - dt * dot(rate[a] - rate[b], D);
                  if ((length < 0) == (before < 0)) return;
                  const double product = 0.5 * k.kn * length * before / dot(D, D);
                  sum += length < 0 ? -product : product;
                });
  return sum;
}

double BondBreaking::stored_energy(std::int64_t n) const {
  const mechanics::CellMotion now = mechanics::cell_motion(model_.lattice, state_.displacement, n);
  double sum = 0;
  for_each_bond(model_.lattice, n, broken_now(n),
                [&](const mechanics::CellBond& bond, const Vec3& D, const mechanics::Stiffness& k) {
                  const Vec3 r = relative(now, bond, D);
                  sum -= mechanics::bond_energy(dot(r, D) < 0 ? 0 : k.kn, k.kt, D, r);
                });
  return sum;
}

void BondBreaking::clear_forces() {
  for (const std::int64_t n : cracked_) forces_.clear(n);
}

void BondBreaking::add_up_forces() {
  for (const std::int64_t n : cracked_) {
    const mechanics::CellMotion now = mechanics::cell_motion(model_.lattice, state_.displacement, n);
    CornerChanges changes;
    for_each_bond(model_.lattice, n, broken_now(n),
                  [&](const mechanics::CellBond& bond, const Vec3& D, const mechanics::Stiffness& k) {
                    const Vec3 r = relative(now, bond, D);
                    changes.take_off(bond, D, r, {dot(r, D) < 0 ? 0 : k.kn, k.kt});
                  });
    changes.add_to(state_.face_force, model_.layout(), n);
  }
}

}  // namespace koshi::failure
