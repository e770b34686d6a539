// Single bonds of single cells: what they carry, and what it does to the corners of the cell.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "koshi/field.h"
#include "mechanics/bond_law.h"
#include "mechanics/cell_bonds.h"
#include "mechanics/cell_stress.h"
#include "mechanics/corners.h"

namespace koshi::failure {

/// Calls f(bond, its D, its springs in the cell) for these bonds of a cell, one for each bit.
template <class F>
void for_each_bond(const model::SpringLattice& body, std::int64_t cell, std::uint32_t bonds, F&& f) {
  if (bonds == 0) return;
  std::array<mechanics::Stiffness, lattice::family_count> parts{};
  for (const lattice::Family family : {lattice::edge, lattice::face, lattice::body})
    parts[family] = mechanics::shared_part(body, family, cell);
  const double d = body.grid.d;
  for (; bonds != 0; bonds &= bonds - 1) {
    const mechanics::CellBond& bond = mechanics::cell_bonds[static_cast<std::size_t>(std::countr_zero(bonds))];
    const auto& [s, family] = lattice::slots[static_cast<std::size_t>(bond.slot)];
    f(bond, Vec3{-d * s[0], -d * s[1], -d * s[2]}, parts[family]);
  }
}

/// Relative displacement of a bond's ends in a motion of its cell.
inline Vec3 relative(const mechanics::CellMotion& motion, const mechanics::CellBond& bond, const Vec3& D) {
  const auto a = static_cast<std::size_t>(bond.a), b = static_cast<std::size_t>(bond.b);
  const auto& [u, w] = motion;
  return mechanics::relative_displacement(u[a], u[b], 0.5 * (w[a] + w[b]), D);
}

/// Forces on the corners of a cell that its kernel, which knows whole bonds, has too much.
struct CornerChanges {
  std::array<Vec3, 8> force{}, turning{};

  /// Takes off springs of a bond with this relative displacement: they would act as -F on its first node, F on its
  /// second, and M on both.
  void take_off(const mechanics::CellBond& bond, const Vec3& D, const Vec3& r, const mechanics::Stiffness& k) {
    const Vec3 F = mechanics::bond_force(k.kn, k.kt, D, r), M = mechanics::bond_moment(D, F);
    const auto first = static_cast<std::size_t>(bond.a), second = static_cast<std::size_t>(bond.b);
    force[first] = force[first] + F;
    force[second] = force[second] - F;
    turning[first] = turning[first] - M;
    turning[second] = turning[second] - M;
  }
  /// Adds the changes to forces and moments on nodes.
  void add_to(lattice::Field<double>& field, const lattice::Layout& layout, std::int64_t cell) const {
    for (int a = 0; a < 8; ++a) {
      const auto corner = static_cast<std::size_t>(a);
      const std::int64_t node = cell + layout.offset(mechanics::corner(a));
      for (int c = 0; c < 3; ++c) {
        field.component(c)[node] += force[corner][static_cast<std::size_t>(c)];
        field.component(3 + c)[node] += turning[corner][static_cast<std::size_t>(c)];
      }
    }
  }
};

}  // namespace koshi::failure
