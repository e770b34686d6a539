#include "koshi/spring_lattice.h"

#include <algorithm>
#include <optional>

#include "lattice/halo.h"

namespace koshi::model {
namespace {

using lattice::slots;

// Offsets, from a bond's first node, to the lowest corners of the cells that contain the bond: along an axis the bond
// spans the cell is fixed, across it the bond lies between two cells.
std::vector<std::array<int, 3>> cells_around(const std::array<int, 3>& s) {
  std::vector<std::array<int, 3>> cells{{0, 0, 0}};
  for (int a = 0; a < 3; ++a) {
    std::vector<std::array<int, 3>> next;
    for (auto c : cells) {
      c[a] = s[a] < 0 ? -1 : 0;
      next.push_back(c);
      if (s[a] == 0) {
        c[a] = -1;
        next.push_back(c);
      }
    }
    cells = next;
  }
  return cells;
}

std::vector<std::int64_t> offsets_around(const lattice::Layout& layout, const std::array<int, 3>& s) {
  std::vector<std::int64_t> offsets;
  for (const auto& c : cells_around(s)) offsets.push_back(layout.offset(c));
  return offsets;
}

// The cell of the whole grid with lowest corner `node` of this rank, periodic directions wrapped around; none outside.
std::optional<Int3> global_cell(const SpringLattice& body, const Int3& node) {
  Int3 c = body.layout.global(node);
  for (int a = 0; a < 3; ++a) {
    const std::int64_t cells = body.grid.cells[a];
    if (body.grid.periodic[a]) c[a] = (c[a] + cells) % cells;
    if (c[a] < 0 || c[a] >= cells) return std::nullopt;
  }
  return c;
}

// Values of all cells that touch an owned node: those with lowest corners -1 ... owned - 1.
template <class T>
lattice::Field<T> make_cell_field(const SpringLattice& body, const std::function<T(const Int3&)>& value_of) {
  lattice::Field<T> field(body.layout, 1);
  for_each_cell(body, [&](const Int3& cell, std::int64_t n) { field.component(0)[n] = value_of(cell); });
  return field;
}

}  // namespace

void for_each_cell(const SpringLattice& body, const std::function<void(const Int3&, std::int64_t)>& f) {
  lattice::for_each(body.layout, {-1, -1, -1}, body.layout.owned(), [&](auto i, auto j, auto k, auto n) {
    if (const auto cell = global_cell(body, {i, j, k})) f(*cell, n);
  });
}

SpringLattice make_cells(const lattice::Grid& grid, std::shared_ptr<const lattice::Partition> partition,
                         std::shared_ptr<const lattice::Halo> halo,
                         const std::function<std::uint16_t(const Int3&)>& material_of) {
  SpringLattice body;
  body.grid = grid;
  body.layout = halo->layout();
  body.partition = std::move(partition);
  body.halo = std::move(halo);
  body.cell = make_cell_field<std::uint16_t>(body, material_of);
  return body;
}

void make_fractions(SpringLattice& body, const std::function<float(const Int3&)>& fraction_of) {
  body.fraction = make_cell_field<float>(body, fraction_of);
  body.factor = body.fraction;
}

void make_surface(SpringLattice& body, const std::function<Moments(const Int3&)>& moments_of) {
  for_each_cell(body, [&](const Int3& cell, std::int64_t n) {
    const double part = body.fraction_of(n);
    if (part > 0 && part < 1) body.surface.push_back({n, moments_of(cell)});
  });
}

void make_factors(SpringLattice& body, const std::function<float(const Int3&)>& factor_of) {
  body.factor = make_cell_field<float>(body, factor_of);
  if (body.fraction.components() == 0) return;
  for (std::size_t n = 0; n < body.factor.count(); ++n) body.factor.data()[n] *= body.fraction.data()[n];
}

std::array<double, lattice::slot_count> count_bonds(const SpringLattice& body, material::Sharing sharing) {
  const std::uint16_t* cell = body.cell.component(0);
  const Int3& owned = body.layout.owned();
  // A bond belongs to the rank that owns its first node; count quarters, so that the sum is one of integers.
  std::array<std::int64_t, lattice::slot_count> quarters{};
  for (int slot = 0; slot < lattice::slot_count; ++slot) {
    const auto& [s, family] = slots[slot];
    const auto around = offsets_around(body.layout, s);
    const std::int64_t share = 4 / lattice::cells_per_bond[family];
    lattice::for_each(body.layout, {0, 0, 0}, owned, [&](auto, auto, auto, auto n) {
      const auto solid = std::count_if(around.begin(), around.end(), [&](auto o) { return cell[n + o] != 0; });
      quarters[slot] += sharing == material::Sharing::shared ? share * solid : solid != 0 ? 4 : 0;
    });
  }
  body.halo->communicator().sum(quarters);
  std::array<double, lattice::slot_count> counts;
  for (int slot = 0; slot < lattice::slot_count; ++slot) counts[slot] = 0.25 * static_cast<double>(quarters[slot]);
  return counts;
}

void set_springs(SpringLattice& body, material::Sharing sharing, material::Kinematics kinematics,
                 std::vector<material::Springs> springs) {
  body.sharing = sharing;
  body.kinematics = kinematics;
  body.springs = std::move(springs);
  if (sharing == material::Sharing::plain) make_bonds(body, body.bond, body.bond_cells);
}

void make_bonds(const SpringLattice& body, lattice::Field<double>& bond, lattice::Field<std::uint8_t>& bond_cells) {
  bond = lattice::Field<double>(body.layout, 2 * lattice::slot_count);
  bond_cells = lattice::Field<std::uint8_t>(body.layout, lattice::slot_count);
  const std::uint16_t* cell = body.cell.component(0);
  for (int slot = 0; slot < lattice::slot_count; ++slot) {
    const int family = lattice::slots[slot].family;
    const auto around = offsets_around(body.layout, lattice::slots[slot].s);
    lattice::for_each_owned(body.layout, [&](auto, auto, auto, auto n) {
      double kn = 0, kt = 0;
      int solid = 0;
      if (body.is_broken(slot, n)) return;
      for (const std::int64_t o : around) {
        const material::Springs& springs = body.springs[cell[n + o]];
        solid += cell[n + o] != 0;
        kn += body.factor_of(n + o) * springs.kn[family];
        kt += body.factor_of(n + o) * springs.kt[family];
      }
      if (solid == 0) return;
      const double parts = body.sharing == material::Sharing::shared ? lattice::cells_per_bond[family] : solid;
      bond.component(2 * slot)[n] = kn / parts;
      bond.component(2 * slot + 1)[n] = kt / parts;
      bond_cells.component(slot)[n] = static_cast<std::uint8_t>(solid);
    });
  }
  body.halo->exchange(bond);
  body.halo->exchange(bond_cells);
}

}  // namespace koshi::model
