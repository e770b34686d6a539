#include "failure/bond_breaking.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "failure/principal.h"
#include "lattice/halo.h"
#include "mechanics/bond_law.h"
#include "mechanics/corners.h"

namespace koshi::failure {
namespace {

using mechanics::cell_bonds;

std::uint16_t bits(double of_field) { return static_cast<std::uint16_t>(of_field); }

}  // namespace

BondBreaking::BondBreaking(model::Model& model, model::State& state)
    : Fracturing(model, state), forces_(model.layout(), state.face_force), bond_rows_(bond_rows()) {
  const lattice::Layout& layout = model.layout();
  const model::SpringLattice& body = model.lattice;
  model.lattice.broken = lattice::Field<std::uint16_t>(layout, 1);
  limits_.resize(1);
  for (std::size_t m = 0; m < model.definition.materials.size(); ++m) {
    const model::MaterialDefinition& material = model.definition.materials[m];
    limits_.emplace_back();
    if (!material.cracks()) continue;
    limits_.back() = bond_limits(*material.fracture, body.springs[m + 1]);
  }

  for (int slot = 0; slot < lattice::slot_count; ++slot) {
    const auto& [s, family] = lattice::slots[static_cast<std::size_t>(slot)];
    for (int side = 0; side < 8; ++side) {
      Int3 cell{};
      bool around = true;
      for (std::size_t a = 0; a < 3; ++a) {
        const int up = side >> a & 1;
        around = around && (s[a] == 0 || up == 0);
        cell[a] = s[a] == 0 ? up - 1 : std::min(s[a], 0);
      }
      if (around) around_[static_cast<std::size_t>(slot)].push_back(cell);
    }
    const bool any =
        std::ranges::any_of(body.springs, [f = family](const auto& springs) { return springs.kn[f] != 0; });
    const double d = body.grid.d;
    if (any) slots_.push_back({layout.offset(s), {-d * s[0], -d * s[1], -d * s[2]}});
  }

  stretch_.resize(static_cast<std::size_t>(layout.owned()[0]));
  shear_.resize(stretch_.size());
  breakable_.resize(static_cast<std::size_t>(layout.owned()[1] * layout.owned()[2]), 0);
  std::size_t breakable = 0;
  lattice::for_each(layout, {-1, -1, -1}, layout.owned(), [&](auto, auto, auto, auto n) {
    if (!breaks_here(n)) return;
    ++breakable;
    mechanics::mark_rows(layout, n, breakable_);
    const BondLimits& limits = *limits_[body.cell.component(0)[n]];
    least_.stretch = std::min(least_.stretch, limits.stretch * model.strength_of(n));
    least_.shear = std::min(least_.shear, limits.shear * model.strength_of(n));
  });
  cracked_.reserve(breakable);
  restore();
}

void BondBreaking::restore() {
  const lattice::Layout& layout = model_.layout();
  const Int3 end{layout.owned()[0] + 1, layout.owned()[1] + 1, layout.owned()[2] + 1};
  model_.lattice.halo->exchange(state_.bonds);
  model_.lattice.halo->exchange(state_.crack);
  model_.lattice.halo->exchange(state_.displacement);
  lattice::for_each(layout, {-1, -1, -1}, end, [&](auto, auto, auto, auto n) {
    model_.lattice.broken.component(0)[n] = bits(state_.bonds.component(0)[n]);
  });
  clear_forces();
  cracked_.clear();
  forces_.forget();
  lattice::for_each(layout, {-1, -1, -1}, layout.owned(), [&](auto, auto, auto, auto n) {
    if (!breaks_here(n) || broken_now(n) == 0) return;
    cracked_.push_back(n);
    forces_.reach(n);
    describe(n);
  });
  add_up_forces();
}

void BondBreaking::follow(double dt) {
  const Int3& owned = model_.layout().owned();
  news_ = false;
  clear_forces();
  const std::size_t before = cracked_.size();
  for (std::int64_t k = 0; k < owned[2]; ++k)
    for (std::int64_t j = 0; j < owned[1]; ++j)
      if (breakable_[static_cast<std::size_t>(j + owned[1] * k)] != 0) follow_row(j, k);
  exchange();
  for (std::size_t c = 0; c < before; ++c)
    state_.crack.component(dissipated)[cracked_[c]] += closing_loss(cracked_[c], dt);
  // In the order of cells in memory, whichever bond broke first.
  if (cracked_.size() != before) std::sort(cracked_.begin(), cracked_.end());
  if (news_) {
    for (const std::int64_t n : cracked_)
      if (const std::uint32_t bonds = fresh(n); bonds != 0) break_in_cell(n, energy_lost(n, bonds, dt));
    make_lattice_follow();
  }
  add_up_forces();
}

// Bonds that other ranks have broken.
void BondBreaking::exchange() {
  if (!model_.lattice.halo->active()) return;
  model_.lattice.halo->exchange(state_.bonds);
  take_over_ghosts();
}

void BondBreaking::look_at_row(std::int64_t j, std::int64_t k) {
  const lattice::Layout& layout = model_.layout();
  bond_rows_({state_.displacement.component(0) + layout.index(0, j, k), state_.displacement.stride()}, slots_.data(),
             slots_.size(), layout.owned()[0], stretch_.data(), std::isinf(least_.shear) ? nullptr : shear_.data());
}

double BondBreaking::bound(std::int64_t i) const {
  const auto at = static_cast<std::size_t>(i);
  const double sheared = std::isinf(least_.shear) ? 0 : std::sqrt(shear_[at]) / least_.shear;
  return std::max(stretch_[at] / least_.stretch, sheared) / margin;
}

void BondBreaking::follow_row(std::int64_t j, std::int64_t k) {
  const lattice::Layout& layout = model_.layout();
  look_at_row(j, k);
  const std::int64_t first = layout.index(0, j, k);
  const bool shears = !std::isinf(least_.shear);
  const double stretch = margin * least_.stretch, square = margin * least_.shear * least_.shear;
  for (std::int64_t i = 0; i < layout.owned()[0]; ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (stretch_[at] >= stretch || (shears && shear_[at] >= square)) look_at(first + i);
  }
}

// The cells of a bond share what it stands by the energy each of them holds at its own limit; a cell that cannot crack
// holds its bonds.
BondLimits BondBreaking::limits_of(std::int64_t n, int slot) const {
  const std::uint16_t* const material = model_.lattice.cell.component(0);
  double kn = 0, kt = 0, stretched = 0, sheared = 0;
  for (const Int3& from : around_[static_cast<std::size_t>(slot)]) {
    const std::int64_t cell = n + from[0] + model_.layout().pitch() * from[1] + model_.layout().plane() * from[2];
    if (material[cell] == 0) continue;
    const std::optional<BondLimits>& limits = limits_[material[cell]];
    const mechanics::Stiffness part =
        mechanics::shared_part(model_.lattice, lattice::slots[static_cast<std::size_t>(slot)].family, cell);
    if (!limits && part.kn > 0) return {};
    if (!limits) continue;
    const double strength = model_.strength_of(cell);
    kn += part.kn;
    kt += part.kt;
    stretched += part.kn * std::pow(strength * limits->stretch, 2);
    if (part.kt > 0) sheared += part.kt * std::pow(strength * limits->shear, 2);
  }
  BondLimits result;
  if (kn > 0) result.stretch = std::sqrt(stretched / kn);
  if (kt > 0) result.shear = std::sqrt(sheared / kt);
  return result;
}

BondBreaking::Strained BondBreaking::strained(std::int64_t n, int slot) const {
  if ((bits(state_.bonds.component(0)[n]) >> slot & 1) != 0) return {};
  const BondLimits limits = limits_of(n, slot);
  if (std::isinf(limits.stretch)) return {};
  const auto three = [this](std::int64_t node, int first) {
    Vec3 v;
    for (int c = 0; c < 3; ++c) v[static_cast<std::size_t>(c)] = state_.displacement.component(first + c)[node];
    return v;
  };
  const auto& s = lattice::slots[static_cast<std::size_t>(slot)].s;
  const double d = model_.lattice.grid.d;
  const Vec3 D{-d * s[0], -d * s[1], -d * s[2]};
  const std::int64_t other = n + model_.layout().offset(s);
  const Vec3 w = 0.5 * (three(n, 3) + three(other, 3));
  const Vec3 r = mechanics::relative_displacement(three(n, 0), three(other, 0), w, D);
  const double stretch = dot(r, D) / dot(D, D);
  return {std::max(stretch, 0.0) / limits.stretch, norm(r - stretch * D) / norm(D) / limits.shear};
}

// The forward bonds of an owned node.
void BondBreaking::look_at(std::int64_t n) {
  for (int slot = 0; slot < lattice::slot_count; ++slot) {
    const Strained over = strained(n, slot);
    const Break way = broken({1, 1}, over.stretch, over.shear);
    if (way != Break::none) break_bond(n, slot, way == Break::by_shear);
  }
}

void BondBreaking::break_bond(std::int64_t n, int slot, bool by_shear) {
  state_.bonds.component(0)[n] += 1U << slot;
  if (by_shear) state_.bonds.component(1)[n] += 1U << slot;
  mark_cells(n, slot);
}

// Bonds of ghost nodes that their owners have broken.
void BondBreaking::take_over_ghosts() {
  const lattice::Layout& layout = model_.layout();
  const Int3& owned = layout.owned();
  const std::uint16_t* const known = model_.lattice.broken.component(0);
  const auto look = [&](std::int64_t n) {
    const unsigned fresh = bits(state_.bonds.component(0)[n]) & ~static_cast<unsigned>(known[n]);
    for (int slot = 0; fresh >> slot != 0; ++slot)
      if ((fresh >> slot & 1) != 0) mark_cells(n, slot);
  };
  for (std::int64_t k = -1; k <= owned[2]; ++k)
    for (std::int64_t j = -1; j <= owned[1]; ++j) {
      const std::int64_t first = layout.index(0, j, k);
      if (j < 0 || k < 0 || j == owned[1] || k == owned[2]) {
        for (std::int64_t i = -1; i <= owned[0]; ++i) look(first + i);
        continue;
      }
      look(first - 1);
      look(first + owned[0]);
    }
}

bool BondBreaking::holds_together(std::uint32_t bonds) {
  unsigned reached = 1;
  for (unsigned before = 0; before != reached;) {
    before = reached;
    for (std::size_t b = 0; b < cell_bonds.size(); ++b) {
      const unsigned ends = 1U << cell_bonds[b].a | 1U << cell_bonds[b].b;
      if ((bonds >> b & 1) != 0 && (reached & ends) != 0) reached |= ends;
    }
  }
  return reached == 0xFF;
}

// The cells around a bond that has broken join those with broken bonds.
void BondBreaking::mark_cells(std::int64_t n, int slot) {
  const Int3 node = model_.layout().place(n);
  for (const Int3& from : around_[static_cast<std::size_t>(slot)]) {
    Int3 at{};
    bool followed = true;
    for (std::size_t a = 0; a < 3; ++a) {
      at[a] = node[a] + from[a];
      followed = followed && at[a] >= -1 && at[a] < model_.layout().owned()[a];
    }
    if (!followed) continue;
    const std::int64_t cell = model_.layout().index(at);
    if (!breaks_here(cell)) continue;
    news_ = true;
    if (state_.crack.component(kappa)[cell] != 0) continue;
    state_.crack.component(kappa)[cell] = 1;
    cracked_.push_back(cell);
    forces_.reach(cell);
  }
}

// Bit b: bond b of the cell is among the forward bonds that `of_node` gives for its first node.
template <class F>
std::uint32_t BondBreaking::of_cell(F&& of_node, std::int64_t n) const {
  std::array<unsigned, 8> masks;
  for (int a = 0; a < 8; ++a)
    masks[static_cast<std::size_t>(a)] = of_node(n + model_.layout().offset(mechanics::corner(a)));
  std::uint32_t result = 0;
  for (std::size_t b = 0; b < cell_bonds.size(); ++b)
    result |= (masks[static_cast<std::size_t>(cell_bonds[b].a)] >> cell_bonds[b].slot & 1) << b;
  return result;
}

// Bit b: bond b of the cell has springs there.
std::uint32_t BondBreaking::bonds_of_cell(std::int64_t n) const {
  const material::Springs& springs = model_.lattice.springs[model_.lattice.cell.component(0)[n]];
  std::uint32_t result = 0;
  for (std::size_t b = 0; b < cell_bonds.size(); ++b)
    if (springs.kn[lattice::slots[static_cast<std::size_t>(cell_bonds[b].slot)].family] > 0) result |= 1U << b;
  return result;
}

std::uint32_t BondBreaking::broken_now(std::int64_t n, int component) const {
  return of_cell([&](std::int64_t node) { return bits(state_.bonds.component(component)[node]); }, n);
}

std::uint32_t BondBreaking::broken_before(std::int64_t n) const {
  return of_cell([&](std::int64_t node) { return model_.lattice.broken.component(0)[node]; }, n);
}

// The cell's fresh bonds have taken this energy.
void BondBreaking::break_in_cell(std::int64_t n, double energy) {
  state_.crack.component(dissipated)[n] += energy;
  if (broken_before(n) == 0) state_.crack.component(shear)[n] = (broken_now(n, 1) & fresh(n)) != 0 ? 1 : 0;
  const double was = state_.crack.component(damage)[n];
  describe(n);
  if (was < model::parted && state_.crack.component(damage)[n] >= model::parted)
    state_.crack.component(moment)[n] = state_.time;
}

// Damage and normal of a cell from its broken bonds: the direction in which most of them lie.
void BondBreaking::describe(std::int64_t n) {
  const std::uint32_t bonds = bonds_of_cell(n), gone = broken_now(n) & bonds;
  const double share = static_cast<double>(std::popcount(gone)) / std::popcount(bonds);
  state_.crack.component(kappa)[n] = 1;
  state_.crack.component(damage)[n] = holds_together(bonds & ~gone) ? share : 1;
  Tensor6 spread{};
  for (std::size_t b = 0; b < cell_bonds.size(); ++b) {
    if ((gone >> b & 1) == 0) continue;
    const auto& [s, family] = lattice::slots[static_cast<std::size_t>(cell_bonds[b].slot)];
    for (std::size_t v = 0; v < 6; ++v)
      spread[v] += static_cast<double>(s[tensor_axes[v][0]] * s[tensor_axes[v][1]]) / lattice::squared_length[family];
  }
  const Vec3 across = principal(spread).direction[0];
  for (int a = 0; a < 3; ++a) state_.crack.component(normal + a)[n] = across[static_cast<std::size_t>(a)];
}

void BondBreaking::make_lattice_follow() {
  for (const std::int64_t n : cracked_)
    for (int a = 0; a < 8; ++a) {
      const std::int64_t node = n + model_.layout().offset(mechanics::corner(a));
      model_.lattice.broken.component(0)[node] = bits(state_.bonds.component(0)[node]);
    }
}

std::int64_t BondBreaking::count() const {
  std::int64_t number = 0;
  lattice::for_each_owned(
      model_.layout(), [&](auto, auto, auto, auto n) { number += std::popcount(bits(state_.bonds.component(0)[n])); });
  return model_.communicator.sum(number);
}

}  // namespace koshi::failure
