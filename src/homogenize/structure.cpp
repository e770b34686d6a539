// What fills the box: pores, which of them go through, their surface, parts of the solid.
#include "homogenize/structure.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "koshi/error.h"
#include "model/regions.h"
#include "statics/parts.h"

namespace koshi::homogenize {
namespace {

/// Sets of cells that are joined; a set goes by its least cell.
class Joined {
 public:
  explicit Joined(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
  std::uint32_t root(std::uint32_t cell) {
    while (parent_[cell] != cell) cell = parent_[cell] = parent_[parent_[cell]];
    return cell;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    if (a < b) std::swap(a, b);
    parent_[a] = b;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

// Pores that lead from one side of the box to the other.
void find_connected_pores(const std::vector<bool>& pore, const Int3& n, Structure& structure) {
  Joined pores(pore.size());
  const std::array<std::int64_t, 3> step{1, n[0], n[0] * n[1]};
  const auto for_each_pore = [&](auto&& f) {
    std::size_t at = 0;
    for (std::int64_t k = 0; k < n[2]; ++k)
      for (std::int64_t j = 0; j < n[1]; ++j)
        for (std::int64_t i = 0; i < n[0]; ++i, ++at)
          if (pore[at]) f(Int3{i, j, k}, static_cast<std::uint32_t>(at));
  };
  for_each_pore([&](const Int3& cell, std::uint32_t at) {
    for (std::size_t a = 0; a < 3; ++a) {
      const auto before = static_cast<std::size_t>(at - step[a]);
      if (cell[a] > 0 && pore[before]) pores.join(at, static_cast<std::uint32_t>(before));
    }
  });
  // Bit 2 a: the pore reaches the lower side across axis a, bit 2 a + 1 the upper one.
  std::vector<std::uint8_t> sides(pore.size());
  for_each_pore([&](const Int3& cell, std::uint32_t at) {
    std::uint8_t& of_pore = sides[pores.root(at)];
    for (std::size_t a = 0; a < 3; ++a) {
      if (cell[a] == 0) of_pore = static_cast<std::uint8_t>(of_pore | 1u << (2 * a));
      if (cell[a] == n[a] - 1) of_pore = static_cast<std::uint8_t>(of_pore | 2u << (2 * a));
    }
  });
  std::array<std::int64_t, 3> through{};
  std::int64_t any = 0;
  for_each_pore([&](const Int3&, std::uint32_t at) {
    const std::uint8_t of_pore = sides[pores.root(at)];
    bool joins = false;
    for (std::size_t a = 0; a < 3; ++a) {
      if ((of_pore >> (2 * a) & 3u) != 3u) continue;
      ++through[a];
      joins = true;
    }
    any += joins;
  });
  const auto cells = static_cast<double>(pore.size());
  structure.connected_porosity = static_cast<double>(any) / cells;
  for (std::size_t a = 0; a < 3; ++a) structure.through[a] = static_cast<double>(through[a]) / cells;
}

}  // namespace

Structure find_structure(const model::Model& model) {
  Structure structure;
  const model::SpringLattice& body = model.lattice;
  const Int3& n = body.grid.cells;
  const auto cells = static_cast<std::size_t>(body.grid.cell_count());
  if (cells >= std::numeric_limits<std::uint32_t>::max())
    throw RunError("the box has more cells than pores can be told apart in; take fewer than 4e9");

  // Every rank looks at the whole box, which it keeps anyway.
  const auto material_of = model::material_of_cells(model.definition, body.grid);
  std::vector<bool> pore;
  pore.reserve(cells);
  for (std::int64_t k = 0; k < n[2]; ++k)
    for (std::int64_t j = 0; j < n[1]; ++j)
      for (std::int64_t i = 0; i < n[0]; ++i) pore.push_back(material_of({i, j, k}) == 0);
  structure.porosity = static_cast<double>(std::count(pore.begin(), pore.end(), true)) / static_cast<double>(cells);
  if (structure.porosity > 0) find_connected_pores(pore, n, structure);

  // Faces between a solid cell and a void one, those across a period too.
  std::int64_t faces = 0;
  const std::array<std::int64_t, 3> step{1, n[0], n[0] * n[1]};
  std::int64_t at = 0;
  for (std::int64_t k = 0; k < n[2]; ++k)
    for (std::int64_t j = 0; j < n[1]; ++j)
      for (std::int64_t i = 0; i < n[0]; ++i, ++at) {
        const Int3 cell{i, j, k};
        for (std::size_t a = 0; a < 3; ++a) {
          const bool last = cell[a] == n[a] - 1;
          if (last && !body.grid.periodic[a]) continue;
          const std::int64_t next = at + (last ? -(n[a] - 1) * step[a] : step[a]);
          faces += pore[static_cast<std::size_t>(at)] != pore[static_cast<std::size_t>(next)];
        }
      }
  structure.specific_surface = static_cast<double>(faces) / (static_cast<double>(cells) * body.grid.d);

  const statics::Parts parts(body);
  structure.islands = static_cast<std::int64_t>(parts.list().size()) - 1;
  for (std::size_t p = 1; p < parts.list().size(); ++p)
    structure.island_fraction += static_cast<double>(parts.list()[p].cells) / static_cast<double>(cells);
  return structure;
}

}  // namespace koshi::homogenize
