// What broken bonds change in forces and energies: whole bonds are in the cell kernel, so that what a broken one would
// carry is taken off, but for the pressure of one that is shortened.
#include <bit>

#include "failure/bond_breaking.h"
#include "mechanics/bond_law.h"
#include "mechanics/corners.h"

namespace koshi::failure {
namespace {

using mechanics::cell_bonds;
using mechanics::CellBond;
using mechanics::CellMotion;
using mechanics::Stiffness;

Vec3 relative(const CellMotion& motion, const CellBond& bond, const Vec3& D) {
  const auto a = static_cast<std::size_t>(bond.a), b = static_cast<std::size_t>(bond.b);
  const auto& [u, w] = motion;
  return mechanics::relative_displacement(u[a], u[b], 0.5 * (w[a] + w[b]), D);
}

}  // namespace

// Calls f(bond, its D, its springs in the cell) for these bonds of a cell.
template <class F>
void BondBreaking::for_each_bond(std::int64_t n, std::uint32_t bonds, F&& f) const {
  std::array<Stiffness, lattice::family_count> parts{};
  for (const lattice::Family family : {lattice::edge, lattice::face, lattice::body})
    parts[family] = mechanics::shared_part(model_.lattice, family, n);
  const double d = model_.lattice.grid.d;
  for (; bonds != 0; bonds &= bonds - 1) {
    const CellBond& bond = cell_bonds[static_cast<std::size_t>(std::countr_zero(bonds))];
    const auto& [s, family] = lattice::slots[static_cast<std::size_t>(bond.slot)];
    f(bond, Vec3{-d * s[0], -d * s[1], -d * s[2]}, parts[family]);
  }
}

// Of central differences: half of K times the displacements before and after the step (theory, 12.7), but for what the
// closed bond keeps.
double BondBreaking::energy_lost(std::int64_t n, std::uint32_t fresh, double dt) const {
  const CellMotion now = mechanics::cell_motion(model_.lattice, state_.displacement, n);
  const CellMotion rate = mechanics::cell_motion(model_.lattice, state_.velocity, n);
  double sum = 0;
  for_each_bond(n, fresh, [&](const CellBond& bond, const Vec3& D, const Stiffness& k) {
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
  for_each_bond(n, broken_before(n), [&](const CellBond& bond, const Vec3& D, const Stiffness& k) {
    const auto a = static_cast<std::size_t>(bond.a), b = static_cast<std::size_t>(bond.b);
    const double length = dot(now[a] - now[b], D), before = length - dt * dot(rate[a] - rate[b], D);
    if ((length < 0) == (before < 0)) return;
    const double product = 0.5 * k.kn * length * before / dot(D, D);
    sum += length < 0 ? -product : product;
  });
  return sum;
}

double BondBreaking::stored_energy(std::int64_t n) const {
  const CellMotion now = mechanics::cell_motion(model_.lattice, state_.displacement, n);
  double sum = 0;
  for_each_bond(n, broken_now(n), [&](const CellBond& bond, const Vec3& D, const Stiffness& k) {
    const Vec3 r = relative(now, bond, D);
    sum -= mechanics::bond_energy(dot(r, D) < 0 ? 0 : k.kn, k.kt, D, r);
  });
  return sum;
}

void BondBreaking::clear_forces() {
  for (const std::int64_t n : cracked_) forces_.clear(n);
}

// A whole bond would act as -F on its first node, F on its second, and M on both.
void BondBreaking::add_up_forces() {
  for (const std::int64_t n : cracked_) {
    const CellMotion now = mechanics::cell_motion(model_.lattice, state_.displacement, n);
    std::array<Vec3, 8> force{}, turning{};
    for_each_bond(n, broken_now(n), [&](const CellBond& bond, const Vec3& D, const Stiffness& k) {
      const Vec3 r = relative(now, bond, D);
      const Vec3 F = mechanics::bond_force(dot(r, D) < 0 ? 0 : k.kn, k.kt, D, r), M = mechanics::bond_moment(D, F);
      const auto first = static_cast<std::size_t>(bond.a), second = static_cast<std::size_t>(bond.b);
      force[first] = force[first] + F;
      force[second] = force[second] - F;
      turning[first] = turning[first] - M;
      turning[second] = turning[second] - M;
    });
    for (int a = 0; a < 8; ++a) {
      const auto corner = static_cast<std::size_t>(a);
      const std::int64_t node = n + model_.layout().offset(mechanics::corner(a));
      for (int c = 0; c < 3; ++c) {
        state_.face_force.component(c)[node] += force[corner][static_cast<std::size_t>(c)];
        state_.face_force.component(3 + c)[node] += turning[corner][static_cast<std::size_t>(c)];
      }
    }
  }
}

}  // namespace koshi::failure
