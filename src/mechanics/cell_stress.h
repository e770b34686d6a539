// Strain and stress of cells.
#pragma once

#include "koshi/spring_lattice.h"
#include "koshi/vector3.h"

namespace koshi::mechanics {

/// Symmetric tensor in the order xx, yy, zz, yz, xz, xy (tensor components, no factor 2).
using Tensor6 = std::array<double, 6>;

struct CellState {
  Tensor6 strain{};   ///< of the linear field fitted to the corners (N22)
  Tensor6 stress{};   ///< [Pa], virial: 1/d^3 sum over the cell's part of its bonds of D F, symmetric, plus kappa theta
                      ///< (N18)
  Vec3 rotation{};    ///< [rad], of the fitted field
  double energy = 0;  ///< elastic energy over the cell's volume [J/m^3]
};

/// Displacements [m] (or velocities) of the corners of a cell, and their rotations with rotational kinematics.
struct CellMotion {
  std::array<Vec3, 8> displacement{}, rotation{};
};
CellMotion cell_motion(const model::SpringLattice& body, const lattice::Field<double>& u, std::int64_t cell);

/// Only the strain of cell_state().
Tensor6 cell_strain(const model::SpringLattice& body, const lattice::Field<double>& u, std::int64_t cell);
/// The same but for its rounding, at a third of the time.
Tensor6 quick_cell_strain(const model::SpringLattice& body, const lattice::Field<double>& u, std::int64_t cell);

/// Of a cell in any motion.
CellState cell_state(const model::SpringLattice& body, const CellMotion& motion, std::int64_t cell);

/// Of the cell with lowest corner `cell`, which must touch an owned node and be solid; ghosts of u up to date.
CellState cell_state(const model::SpringLattice& body, const lattice::Field<double>& u, std::int64_t cell);

/// The same with stress and energy of the material in the cell: of a cell that a surface cuts, over the part inside.
CellState material_state(const model::SpringLattice& body, const lattice::Field<double>& u, std::int64_t cell);

/// Mean over the solid cells around an owned node: the whole ones, or the cut ones where there are no others.
CellState node_state(const model::SpringLattice& body, const lattice::Field<double>& u, std::int64_t node);

}  // namespace koshi::mechanics
