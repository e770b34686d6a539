// Damage that a program gives.
#include <fmt/format.h>

#include "base/collective.h"
#include "failure/cracking.h"
#include "koshi/error.h"

namespace koshi::failure {

void Cracking::damage_cells(const lattice::Field<double>& wanted, const Vec3& n) {
  const lattice::Layout& layout = model_.layout();
  const Vec3 unit = (1 / norm(n)) * n;
  const auto check = [&](const Int3& cell, std::int64_t at) {
    const double value = wanted.component(0)[at];
    const auto fail = [&](const std::string& message) {
      throw InputError(fmt::format("damage: error: the damage of cell ({}, {}, {}) is to be {:.6g}; {}", cell[0],
                                   cell[1], cell[2], value, message));
    };
    if (!(value >= 0 && value <= 1)) fail("it lies between 0 and 1");
    if (value > 0 && !laws_[model_.lattice.cell.component(0)[at]])
      fail("the cell is empty or of a material without fracture");
  };
  // Nothing changes unless all of it can.
  collectively(model_.communicator, [&] {
    lattice::for_each_owned(layout, [&](auto i, auto j, auto k, auto at) { check(layout.global({i, j, k}), at); });
  });
  lattice::for_each_owned(layout, [&](auto, auto, auto, auto at) {
    const double value = wanted.component(0)[at];
    const Crack before = load(at);
    if (value <= before.damage) return;
    Crack crack = law(at).damaged(before.kappa > 0 ? before.normal : unit, value, model_.strength_of(at));
    crack.slip = before.slip;
    crack.shear = before.shear;
    store(at, crack);
  });
  restore();
}

}  // namespace koshi::failure
