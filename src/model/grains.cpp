#include "model/grains.h"

#include <fmt/format.h>

#include "model/check.h"
#include "model/regions.h"

namespace koshi::model {

std::function<bool(const Int3&)> grain_boundaries(const Definition& definition, const lattice::Grid& grid) {
  const std::vector<std::int32_t>& labels = definition.body.grain_boundary->label_of_cells;
  const Int3 n = grid.cells;
  if (!labels.empty() && static_cast<std::int64_t>(labels.size()) != grid.cell_count())
    Checker(definition)
        .fail("body.grain_boundary.labels", fmt::format("there are labels for {} cells, but the body has {} x {} x {}",
                                                        labels.size(), n[0], n[1], n[2]));
  const auto material_of = material_of_grains(definition, grid);
  const auto grain_of = [&labels, n, material_of](const Int3& cell) -> std::int64_t {
    return labels.empty() ? material_of(cell)
                          : labels[static_cast<std::size_t>(cell[0] + n[0] * (cell[1] + n[1] * cell[2]))];
  };
  return [grid, material_of, grain_of](const Int3& cell) {
    if (material_of(cell) == 0) return false;
    for (std::size_t a = 0; a < 3; ++a)
      for (const std::int64_t side : {-1, 1}) {
        Int3 next = cell;
        next[a] += side;
        if (grid.periodic[a]) next[a] = (next[a] + grid.cells[a]) % grid.cells[a];
        if (next[a] < 0 || next[a] >= grid.cells[a] || material_of(next) == 0) continue;
        if (grain_of(next) != grain_of(cell)) return true;
      }
    return false;
  };
}

}  // namespace koshi::model
