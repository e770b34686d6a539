#include "failure/broken_bonds.h"

#include <algorithm>
#include <bit>

#include "base/exact_sum.h"
#include "failure/cell_bond_forces.h"

namespace koshi::failure {
namespace {

using mechanics::CellBond;
using mechanics::CellMotion;
using mechanics::Stiffness;

// Changes of length this much smaller than the largest shortening are those of the solver's tolerance, and change
// nothing.
constexpr double still = 1e-6;
// What the levels take of a cell that holds its corners together no longer. The bonds that are left in it may hold
// nodes that nothing else does: with much less than they do the solver would take long to see it.
constexpr double least_share = 0.01;

// Change of length of a bond times its length [m^2]; rotations do not count.
double lengthening(const CellMotion& motion, const CellBond& bond, const Vec3& D) {
  return dot(
      motion.displacement[static_cast<std::size_t>(bond.a)] - motion.displacement[static_cast<std::size_t>(bond.b)], D);
}

std::uint32_t bit_of(const CellBond& bond) { return 1U << (&bond - mechanics::cell_bonds.data()); }

}  // namespace

BrokenBonds::BrokenBonds(BondBreaking& breaking, model::Model& model, model::State& state)
    : breaking_(breaking), model_(model), state_(state), before_(model.layout(), model.components()) {
  if (model.lattice.factor.components() == 0) model::make_factors(model.lattice, [](const Int3&) { return 1.0F; });
  state_.face_force.zero();
  for (const std::int64_t n : breaking_.cracked_) cells_.push_back({n, breaking_.broken_now(n), 0, 0});
}

template <class F>
void BrokenBonds::for_each_lost(const Cell& cell, std::uint32_t bonds, F&& f) const {
  for_each_bond(model_.lattice, cell.cell, bonds, [&](const CellBond& bond, const Vec3& D, const Stiffness& k) {
    constexpr double lost = 1 - Fracturing::trace;
    f(bond, D, Stiffness{(cell.closed & bit_of(bond)) != 0 ? 0 : lost * k.kn, lost * k.kt});
  });
}

const BrokenBonds::Cell& BrokenBonds::at(std::int64_t cell) const {
  return *std::ranges::lower_bound(cells_, cell, {}, &Cell::cell);
}

void BrokenBonds::renew() {
  std::vector<Cell> cells;
  auto known = cells_.begin();
  for (const std::int64_t n : breaking_.cracked_) {
    while (known != cells_.end() && known->cell < n) ++known;
    Cell cell = known != cells_.end() && known->cell == n ? *known : Cell{n, 0, 0, 0};
    const std::uint32_t broken = breaking_.broken_now(n), fresh = broken & ~cell.broken;
    const CellMotion now = mechanics::cell_motion(model_.lattice, state_.displacement, n);
    for_each_bond(model_.lattice, n, fresh, [&](const CellBond& bond, const Vec3& D, const Stiffness&) {
      if (lengthening(now, bond, D) < 0) cell.closed |= bit_of(bond);
    });
    cell.broken = broken;
    cell.closed &= broken;
    cells.push_back(cell);
  }
  cells_ = std::move(cells);
}

void BrokenBonds::note() {
  before_ = state_.displacement;
  for (Cell& cell : cells_) cell.closed_before = cell.closed;
}

// Of a bond that is closed by now the normal spring was never gone.
double BrokenBonds::energy_lost(std::int64_t n) const {
  const CellMotion before = mechanics::cell_motion(model_.lattice, before_, n),
                   now = mechanics::cell_motion(model_.lattice, state_.displacement, n);
  double sum = 0;
  for_each_lost(at(n), breaking_.fresh(n), [&](const CellBond& bond, const Vec3& D, const Stiffness& k) {
    sum += 0.5 * dot(relative(before, bond, D), mechanics::bond_force(k.kn, k.kt, D, relative(now, bond, D)));
  });
  return sum;
}

double BrokenBonds::energy_held(std::int64_t n) const {
  const CellMotion before = mechanics::cell_motion(model_.lattice, before_, n);
  double sum = 0;
  for_each_lost(at(n), breaking_.fresh(n), [&](const CellBond& bond, const Vec3& D, const Stiffness& k) {
    sum += mechanics::bond_energy(k.kn, k.kt, D, relative(before, bond, D));
  });
  return sum;
}

bool BrokenBonds::has_parted() const {
  bool parted = false;
  for (const Cell& cell : cells_) {
    const CellMotion now = mechanics::cell_motion(model_.lattice, state_.displacement, cell.cell);
    for_each_lost(cell, cell.broken, [&](const CellBond& bond, const Vec3& D, const Stiffness&) {
      parted = parted || lengthening(now, bond, D) > dot(D, D);
    });
  }
  return model_.communicator.any(parted);
}

bool BrokenBonds::look() {
  const double d = model_.lattice.grid.d;
  double most = 0;
  const auto for_each_length = [&](Cell& cell, auto&& f) {
    const CellMotion now = mechanics::cell_motion(model_.lattice, state_.displacement, cell.cell);
    for_each_bond(model_.lattice, cell.cell, cell.broken, [&](const CellBond& bond, const Vec3& D, const Stiffness&) {
      f(bit_of(bond), lengthening(now, bond, D) / d);
    });
  };
  for (Cell& cell : cells_)
    for_each_length(cell, [&](std::uint32_t, double length) { most = std::max(most, -length); });
  most = model_.communicator.max(most);
  bool changed = false;
  for (Cell& cell : cells_) {
    std::uint32_t closed = 0;
    for_each_length(cell, [&](std::uint32_t bit, double length) {
      if (length < ((cell.closed & bit) != 0 ? still : -still) * most) closed |= bit;
    });
    changed = changed || closed != cell.closed;
    cell.closed = closed;
  }
  return model_.communicator.any(changed);
}

double BrokenBonds::energy() const {
  ExactSum sum;
  for (const Cell& cell : cells_) {
    if (!is_owned(cell.cell)) continue;
    const CellMotion now = mechanics::cell_motion(model_.lattice, state_.displacement, cell.cell);
    double lost = 0;
    for_each_lost(cell, cell.broken, [&](const CellBond& bond, const Vec3& D, const Stiffness& k) {
      lost += mechanics::bond_energy(k.kn, k.kt, D, relative(now, bond, D));
    });
    sum += -lost;
  }
  sum.sum_ranks(model_.communicator);
  return sum.value();
}

// As of cells, ClosedFaces::bend(); of bonds that were broken before.
double BrokenBonds::bend() const {
  ExactSum sum;
  for (const Cell& cell : cells_) {
    const std::uint32_t turned = (cell.closed ^ cell.closed_before) & breaking_.broken_before(cell.cell);
    if (turned == 0 || !is_owned(cell.cell)) continue;
    const CellMotion before = mechanics::cell_motion(model_.lattice, before_, cell.cell),
                     now = mechanics::cell_motion(model_.lattice, state_.displacement, cell.cell);
    for_each_bond(model_.lattice, cell.cell, turned, [&](const CellBond& bond, const Vec3& D, const Stiffness& k) {
      const double product =
          0.5 * (1 - Fracturing::trace) * k.kn * lengthening(before, bond, D) * lengthening(now, bond, D) / dot(D, D);
      sum += (cell.closed & bit_of(bond)) != 0 ? product : -product;
    });
  }
  sum.sum_ranks(model_.communicator);
  return sum.value();
}

void BrokenBonds::update(const lattice::Field<double>& u) {
  for (const Cell& cell : cells_) breaking_.forces_.clear(cell.cell);
  for (const Cell& cell : cells_) {
    const CellMotion now = mechanics::cell_motion(model_.lattice, u, cell.cell);
    CornerChanges changes;
    for_each_lost(cell, cell.broken, [&](const CellBond& bond, const Vec3& D, const Stiffness& k) {
      changes.take_off(bond, D, relative(now, bond, D), k);
    });
    changes.add_to(state_.face_force, model_.layout(), cell.cell);
  }
}

double BrokenBonds::share_left(const Cell& cell) const {
  const std::uint32_t bonds = breaking_.bonds_of_cell(cell.cell), left = bonds & (~cell.broken | cell.closed);
  if (!BondBreaking::holds_together(left)) return least_share;
  return static_cast<double>(std::popcount(left)) / std::popcount(bonds);
}

void BrokenBonds::make_levels(const std::function<void()>& make) {
  float* const factor = model_.lattice.factor.component(0);
  std::vector<float> whole;
  soft_.clear();
  for (const Cell& cell : cells_) {
    whole.push_back(factor[cell.cell]);
    const double share = share_left(cell);
    factor[cell.cell] = static_cast<float>(share * static_cast<double>(factor[cell.cell]));
    if (share == least_share) soft_.push_back(cell.cell);
  }
  make();
  std::size_t next = 0;
  for (const Cell& cell : cells_) factor[cell.cell] = whole[next++];
}

bool BrokenBonds::ask_for_levels() const {
  return model_.communicator.any(std::ranges::any_of(cells_, [this](const Cell& cell) {
    return std::ranges::binary_search(soft_, cell.cell) && share_left(cell) != least_share;
  }));
}

}  // namespace koshi::failure
