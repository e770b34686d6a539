// The cells of a body that have cracked through, from all ranks.
#pragma once

#include <cstdint>
#include <vector>

#include "koshi/model.h"

namespace koshi::driver {

struct CrackedCell {
  std::int64_t number = 0;  ///< i + n_x (j + n_y k) of the cell
  double moment = 0;        ///< when its damage passed model::parted [s]; 0: before the run
  double damage = 0;
  double opening = 0;  ///< [m]
  double energy = 0;   ///< that its crack and the friction of its faces have taken so far [J]
  double shear = 0;    ///< 1 if the shear limit began it, else 0
  Vec3 normal{};
};

/// Indices (i, j, k) of the cell with this number.
inline Int3 cell_indices(const lattice::Grid& grid, std::int64_t number) {
  return {number % grid.cells[0], number / grid.cells[0] % grid.cells[1], number / (grid.cells[0] * grid.cells[1])};
}

/// Opening of the crack in a cell [m]: omega h times the strain across it, with the band width h of its normal (theory,
/// 12); 0 where it is closed or there is none. Ghosts of the displacements must be up to date.
double crack_opening(const model::Model& model, const model::State& state, std::int64_t cell);

/// Cells with a damage of model::parted and more, by number; empty on all ranks but the root (collective).
std::vector<CrackedCell> cracked_cells(const model::Model& model, const model::State& state);

}  // namespace koshi::driver
