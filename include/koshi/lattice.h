// The lattice: unit cells, bond families and bond slots.
//
// Vocabulary. A *cell* is a cube of side d (spacing); *nodes* sit on cell corners; *bonds* join corners of one cell.
// A *family* is the set of bonds of one length: edges (d), face diagonals (sqrt 2 d), body diagonals (sqrt 3 d).
// A *slot* is one of the 13 forward directions s; the bond of node n in slot s ends at n + s. Backward bonds are the
// forward bonds of the node at n - s.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "koshi/vector3.h"

namespace koshi::lattice {

/// Unit cells of Nishimura et al., Fig. 3: edges; edges and face diagonals; edges, face and body diagonals.
enum class CellType { cube_i, cube_ii, cube_iii };

/// Bonds of one length.
enum Family { edge = 0, face = 1, body = 2 };
inline constexpr int family_count = 3;  ///< of a unit cell with all bonds
inline constexpr int slot_count = 13;   ///< forward directions

/// Direction of a bond from the node that owns it.
struct Slot {
  std::array<int, 3> s;  ///< direction in cells: each component -1, 0 or 1
  Family family;         ///< by length
};

/// The 13 forward directions: 3 edges, 6 face diagonals, 4 body diagonals; their negatives are the backward ones.
inline constexpr std::array<Slot, slot_count> slots{{
    {{1, 0, 0}, edge},
    {{0, 1, 0}, edge},
    {{0, 0, 1}, edge},
    {{1, 1, 0}, face},
    {{-1, 1, 0}, face},
    {{1, 0, 1}, face},
    {{-1, 0, 1}, face},
    {{0, 1, 1}, face},
    {{0, -1, 1}, face},
    {{1, 1, 1}, body},
    {{-1, 1, 1}, body},
    {{1, -1, 1}, body},
    {{-1, -1, 1}, body},
}};

/// Number of cells that contain a bond of a family inside the bulk; a cell owns 1 / this of the bond.
inline constexpr std::array<int, family_count> cells_per_bond{4, 2, 1};

/// Squared length of a family's bonds in units of d^2.
inline constexpr std::array<int, family_count> squared_length{1, 2, 3};

/// Families a unit cell has: 1, 2 or 3.
constexpr int families_of(CellType type) { return static_cast<int>(type) + 1; }

/// The word in input and output.
constexpr std::string_view name(CellType type) {
  constexpr std::array<std::string_view, 3> names{"cube-I", "cube-II", "cube-III"};
  return names[static_cast<std::size_t>(type)];
}

}  // namespace koshi::lattice
