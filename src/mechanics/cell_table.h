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

}  // namespace koshi::mechanics
