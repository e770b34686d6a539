// The constants of a cell, from its springs.
#pragma once

#include <array>

#include "koshi/springs.h"
#include "mechanics/cell_strip.h"

namespace koshi::mechanics {

/// Constants of one cell, cell_strip.h; linear in the springs.
using CellConstants = std::array<double, cell_constants>;

/// Constants [N/m] of a cell with shared springs of side d [m].
inline CellConstants springs_of_cell(const material::Springs& springs, double d) {
  const auto& kn = springs.kn;
  const auto& kt = springs.kt;
  return {kn[0] / 16,           kt[0] / 16, (kn[1] - kt[1]) / 16,  kt[1] / 8,
          (kn[2] - kt[2]) / 12, kt[2] / 4,  springs.kappa * d / 16};
}

/// The springs of cells with d = 2 that have one of these constants equal to 1 and the others 0.
inline constexpr std::array<material::Springs, cell_constants> unit_springs{{{{16, 0, 0}, {0, 0, 0}, 0},
                                                                             {{0, 0, 0}, {16, 0, 0}, 0},
                                                                             {{0, 16, 0}, {0, 0, 0}, 0},
                                                                             {{0, 8, 0}, {0, 8, 0}, 0},
                                                                             {{0, 0, 12}, {0, 0, 0}, 0},
                                                                             {{0, 0, 4}, {0, 0, 4}, 0},
                                                                             {{0, 0, 0}, {0, 0, 0}, 8}}};

}  // namespace koshi::mechanics
