#include "koshi/spring_lattice.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "koshi/error.h"
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

/// Family of a bond and the materials of the up to four cells around it, ascending.
using ClassKey = std::array<std::uint8_t, 5>;

// Calls f(slot, node, key) for the forward bonds of all owned nodes that have a solid cell around them.
template <class F>
void for_each_bond(const SpringLattice& body, F&& f) {
  const std::uint8_t* cell = body.cell.component(0);
  for (int slot = 0; slot < lattice::slot_count; ++slot) {
    const auto around = offsets_around(body.layout, slots[slot].s);
    ClassKey found{}, key{};
    lattice::for_each_owned(body.layout, [&](auto, auto, auto, auto n) {
      ClassKey here{static_cast<std::uint8_t>(slots[slot].family)};
      for (std::size_t c = 0; c < around.size(); ++c) here[c + 1] = cell[n + around[c]];
      // Neighbours mostly have the same cells around them.
      if (here != found) {
        found = key = here;
        std::sort(key.begin() + 1, key.end());
      }
      if (key.back() != 0) f(slot, n, key);
    });
  }
}

// The classes that occur on any rank, in ascending order (collective).
std::set<ClassKey> all_classes(const SpringLattice& body) {
  std::set<ClassKey> own;
  ClassKey last{};
  for_each_bond(body, [&](int, std::int64_t, const ClassKey& key) {
    if (key != last) own.insert(last = key);
  });
  std::string bytes;
  for (const ClassKey& key : own) bytes.append(key.begin(), key.end());
  const Communicator& communicator = body.halo->communicator();
  bytes = communicator.broadcast(communicator.gather(bytes));
  std::set<ClassKey> all;
  for (std::size_t at = 0; at < bytes.size(); at += ClassKey{}.size()) {
    ClassKey key;
    std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), key.size(), key.begin());
    all.insert(key);
  }
  return all;
}

BondClass make_class(lattice::Family family, const ClassKey& key, material::Sharing sharing,
                     const std::vector<material::Springs>& springs) {
  BondClass bond;
  for (std::size_t c = 1; c < key.size(); ++c) {
    const std::uint8_t m = key[c];
    if (m == 0) continue;
    ++bond.solid_cells;
    bond.kn += springs[m].kn[family];
    bond.kt += springs[m].kt[family];
  }
  const double parts = sharing == material::Sharing::shared ? lattice::cells_per_bond[family] : bond.solid_cells;
  bond.kn /= parts;
  bond.kt /= parts;
  return bond;
}

}  // namespace

bool SpringLattice::has_volumetric() const {
  return std::any_of(springs.begin(), springs.end(), [](const material::Springs& s) { return s.kappa != 0; });
}

SpringLattice make_cells(const lattice::Grid& grid, std::shared_ptr<const lattice::Partition> partition,
                         std::shared_ptr<const lattice::Halo> halo,
                         const std::function<std::uint8_t(const Int3&)>& material_of) {
  SpringLattice body;
  body.grid = grid;
  body.layout = halo->layout();
  body.partition = std::move(partition);
  body.halo = std::move(halo);
  // Cells that touch an owned node have lowest corners -1 ... owned - 1; periodic directions wrap around.
  body.cell = lattice::Field<std::uint8_t>(body.layout, 1);
  std::uint8_t* cell = body.cell.component(0);
  lattice::for_each(body.layout, {-1, -1, -1}, body.layout.owned(), [&](auto i, auto j, auto k, auto n) {
    Int3 c = body.layout.global({i, j, k});
    for (int a = 0; a < 3; ++a) {
      if (grid.periodic[a]) c[a] = (c[a] + grid.cells[a]) % grid.cells[a];
      if (c[a] < 0 || c[a] >= grid.cells[a]) return;
    }
    cell[n] = material_of(c);
  });
  return body;
}

std::array<double, lattice::slot_count> count_bonds(const SpringLattice& body, material::Sharing sharing) {
  const std::uint8_t* cell = body.cell.component(0);
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

void make_bonds(SpringLattice& body, material::Sharing sharing, material::Kinematics kinematics,
                std::vector<material::Springs> springs) {
  body.sharing = sharing;
  body.kinematics = kinematics;
  body.springs = std::move(springs);
  body.classes.assign(1, BondClass{});

  // Every rank numbers the classes alike: by family, then by the materials around the bond.
  const auto classes = all_classes(body);
  std::map<ClassKey, std::uint8_t> number;
  for (const ClassKey& key : classes) {
    const BondClass made = make_class(static_cast<lattice::Family>(key[0]), key, sharing, body.springs);
    // A family the unit cell does not have leaves its bonds absent.
    if (made.kn == 0 && made.kt == 0) continue;
    if (body.classes.size() > SpringLattice::max_classes)
      throw InputError(fmt::format(
          "the mixtures of materials around bonds need more than {} kinds of bonds; merge similar materials "
          "(about 6 may touch each other in every combination)",
          SpringLattice::max_classes));
    number[key] = static_cast<std::uint8_t>(body.classes.size());
    body.classes.push_back(made);
  }

  body.bond = lattice::Field<std::uint8_t>(body.layout, lattice::slot_count);
  ClassKey last{};
  std::uint8_t last_number = 0;
  for_each_bond(body, [&](int slot, std::int64_t n, const ClassKey& key) {
    // Neighbours mostly have the same class.
    if (key != last) {
      last = key;
      const auto found = number.find(key);
      last_number = found == number.end() ? std::uint8_t{0} : found->second;
    }
    body.bond.component(slot)[n] = last_number;
  });
  body.halo->exchange(body.bond);
}

}  // namespace koshi::model
