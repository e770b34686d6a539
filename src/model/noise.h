// Random numbers that belong to cells: a hash of the cell's place and a seed, so that no rank depends on another.
#pragma once

#include <cstdint>
#include <vector>

#include "koshi/grid.h"

namespace koshi::model {

/// A standard normal number for a cell of the lattice, which may lie outside the body.
double normal_number(const Int3& cell, std::uint64_t seed);

/// Standard normal numbers of the cells lo <= c < hi, x fastest, of which those r cells apart are correlated by
/// exp(-(r/length)^2); length 0: not at all. In periodic directions of the grid they go on across the border. Every
/// number has the same bits whatever box it is asked for in.
std::vector<double> gaussian_numbers(const lattice::Grid& grid, const Int3& lo, const Int3& hi, double length,
                                     std::uint64_t seed);

}  // namespace koshi::model
