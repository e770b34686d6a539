// Which material each cell of the body is.
#pragma once

#include <cstdint>
#include <functional>

#include "koshi/definition.h"
#include "koshi/grid.h"
#include "koshi/spring_lattice.h"

namespace koshi::model {

/// The grid of the body; throws InputError when a size is no positive multiple of the spacing or the body has more
/// cells than can be counted.
lattice::Grid make_grid(const Definition& definition);

/// The index of a material that check() has found to be defined; 0 for "void".
std::uint16_t material_index(const Definition& definition, const std::string& name);

/// Material index (0 = empty) of a global cell: the body's material or image, then the regions, later ones winning. A
/// cell belongs to a region when its centre lies inside or on the border; where regions cut cells it is what fills most
/// of it, and slivers are empty. The definition must have passed check() and outlive the function.
std::function<std::uint16_t(const Int3&)> material_of_grains(const Definition& definition, const lattice::Grid& grid);

/// The same, and then cells along grain boundaries become what they are to be.
std::function<std::uint16_t(const Int3&)> material_of_cells(const Definition& definition, const lattice::Grid& grid);

/// Part of each cell that is solid by its global indices; null where regions cut no cells. As above.
std::function<float(const Int3&)> fraction_of_cells(const Definition& definition, const lattice::Grid& grid);

/// Moments of the solid part of a cell that surfaces cut, by its global indices. As above.
std::function<Moments(const Int3&)> moments_of_cells(const Definition& definition, const lattice::Grid& grid);

/// Factor of each cell, without its fraction, by its global indices; null where the definition gives none. Errors:
/// InputError when there is not one for each cell, or one outside 0 ... 1. The definition must outlive the function.
std::function<float(const Int3&)> factor_of_cells(const Definition& definition, const lattice::Grid& grid);

/// Share of its material's density that each cell has, by its global indices; those across a period are brought back.
/// Null where the definition gives none. Errors: InputError when there is not one for each cell. The definition must
/// outlive the function.
std::function<double(Int3)> density_share_of_cells(const Definition& definition, const lattice::Grid& grid);

}  // namespace koshi::model
