// The body as springs: which cells are solid, which bonds exist and how stiff they are. Frozen after construction.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "koshi/field.h"
#include "koshi/springs.h"
#include "koshi/vector3.h"

namespace koshi::lattice {
class Halo;
struct Partition;
}  // namespace koshi::lattice

namespace koshi::model {

/// A spring between a place in a cell and the ground: it resists e = direction . sum of weights u with the energy
/// stiffness e^2/2.
struct GroundSpring {
  std::int64_t cell = 0;            ///< index of its lowest corner
  std::array<double, 8> weights{};  ///< shape functions of the corners at the place
  Vec3 direction{};                 ///< of length 1
  double stiffness = 0;             ///< [N/m]
  Vec3 surface{};                   ///< place of the surface that it stands for [m]
  int region = 0;                   ///< whose surface that is, index into Definition::regions
};

/// Number of different integrals of x^a y^b z^c over a part of a cell that the energy of a trilinear displacement has.
inline constexpr int moment_count = 23;

/// These integrals over a cell's volume, x from the cell's centre in half edges; the first is the fraction inside.
/// Order: model/moments.h.
using Moments = std::array<double, moment_count>;

/// A cell that a surface cuts.
struct SurfaceCell {
  std::int64_t cell = 0;  ///< index of its lowest corner
  Moments moments{};      ///< of the part inside
};

/// Cells and springs on one rank's nodes and ghosts. Fields of cells have one component, with the cell's value at the
/// index of its lowest corner; they are known for the cells that touch an owned node.
struct SpringLattice {
  static constexpr int max_materials = 65535;  ///< a cell names its material by two bytes

  lattice::Grid grid;                                                  ///< of the whole body
  lattice::Layout layout;                                              ///< of this rank's nodes
  std::shared_ptr<const lattice::Partition> partition;                 ///< boxes of all ranks
  std::shared_ptr<const lattice::Halo> halo;                           ///< exchange of ghost values
  material::Sharing sharing = material::Sharing::shared;               ///< how bonds get their stiffness
  material::Kinematics kinematics = material::Kinematics::rotational;  ///< where rotations come from

  lattice::Field<std::uint16_t> cell;  ///< material index of cells, 0 = empty
  /// Factor s of cells, 0 ... 1, on all springs of a cell with its share of bonds; no components where all are 1.
  /// Kernels and measures read it every time, so its values may change between two steps; a static analysis makes its
  /// hierarchy from it when it begins. Shared springs only.
  lattice::Field<float> factor;
  /// Part of a cell's volume that is inside the body; no components where surfaces cut no cells. Factors have it in
  /// them. Frozen.
  lattice::Field<float> fraction;
  /// Of nodes: bit `slot` of the forward bonds that are broken, all of their cells' shares; no components where bonds
  /// do not break. Measures and make_bonds() leave them out, the cell kernel does not.
  lattice::Field<std::uint16_t> broken;
  std::vector<SurfaceCell> surface;        ///< cells with a fraction between 0 and 1, by index; frozen
  std::vector<material::Springs> springs;  ///< by material index; entry 0 (empty) is zero
  /// Plain springs only, known on owned and ghost nodes: stiffness of forward bonds, component 2 slot: kn [N/m],
  /// 2 slot + 1: kt [N/m].
  lattice::Field<double> bond;
  lattice::Field<std::uint8_t> bond_cells;  ///< the same: solid cells around forward bonds, component slot
  std::vector<GroundSpring> ground;         ///< of cells that touch an owned node, in one order on any ranks

  /// Unknowns per node: three displacements, and three rotations with rotational kinematics.
  int components() const { return kinematics == material::Kinematics::rotational ? 6 : 3; }
  /// Of the cell at index n, 1 where there is no field of factors.
  double factor_of(std::int64_t n) const {
    return factor.components() == 0 ? 1 : static_cast<double>(factor.component(0)[n]);
  }
  /// Whether the forward bond of the node at index n in this slot is broken.
  bool is_broken(int slot, std::int64_t n) const {
    return broken.components() != 0 && (broken.component(0)[n] >> slot & 1) != 0;
  }
  /// Of the cell at index n, 1 where there is no field of fractions.
  double fraction_of(std::int64_t n) const {
    return fraction.components() == 0 ? 1 : static_cast<double>(fraction.component(0)[n]);
  }
};

/// A lattice with its cells, not yet its springs: `material_of(global cell)` gives the material index (0 = empty);
/// cells outside the body are empty.
SpringLattice make_cells(const lattice::Grid& grid, std::shared_ptr<const lattice::Partition> partition,
                         std::shared_ptr<const lattice::Halo> halo,
                         const std::function<std::uint16_t(const Int3&)>& material_of);

/// Gives the cells the parts of their volume that are inside: `fraction_of(global cell)`, 0 ... 1; the factors of the
/// cells are the same.
void make_fractions(SpringLattice& body, const std::function<float(const Int3&)>& fraction_of);

/// Gives the cells with a fraction between 0 and 1 the moments of the part inside, `moments_of(global cell)`.
void make_surface(SpringLattice& body, const std::function<Moments(const Int3&)>& moments_of);

/// Gives the cells factors, `factor_of(global cell)`, 0 ... 1, times their fractions.
void make_factors(SpringLattice& body, const std::function<float(const Int3&)>& factor_of);

/// Calls f(global cell, index) for the cells that touch an owned node; cells outside the body are left out.
void for_each_cell(const SpringLattice& body, const std::function<void(const Int3&, std::int64_t)>& f);

/// Bonds of the whole body by slot (collective): with plain springs each counts one, with shared springs the part of it
/// that its solid cells own. Families the unit cell lacks are counted as if they were there.
std::array<double, lattice::slot_count> count_bonds(const SpringLattice& body, material::Sharing sharing);

/// Adds the springs, by material index, entry 0 zero (collective).
void set_springs(SpringLattice& body, material::Sharing sharing, material::Kinematics kinematics,
                 std::vector<material::Springs> springs);

/// Stiffness of every bond of the body as it is now, stored as in SpringLattice (collective). Shared springs: a bond is
/// the sum of its cells' shares, factors included. Plain springs: the mean over its solid cells.
void make_bonds(const SpringLattice& body, lattice::Field<double>& bond, lattice::Field<std::uint8_t>& bond_cells);

}  // namespace koshi::model
