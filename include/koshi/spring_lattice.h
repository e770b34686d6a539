// The body as springs: which cells are solid, which bonds exist and how stiff they are. Frozen after construction.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "koshi/field.h"
#include "koshi/springs.h"

namespace koshi::lattice {
class Halo;
struct Partition;
}  // namespace koshi::lattice

namespace koshi::model {

/// Stiffness of the bonds of one class: one family, one mixture of materials around the bond.
struct BondClass {
  double kn = 0;        ///< [N/m]
  double kt = 0;        ///< [N/m]
  int solid_cells = 0;  ///< cells that share the bond and are not empty
};

/// Cells, bonds and springs on one rank's nodes and ghosts.
/// - cell: component 0, material index of a cell (0 = empty) at the index of its lowest corner; known for the cells
///   that touch an owned node.
/// - bond: component = slot, class of a node's forward bond (0 = absent); known on owned and ghost nodes.
struct SpringLattice {
  static constexpr int max_materials = 255;  ///< a cell names its material by a byte
  static constexpr int max_classes = 255;    ///< and a node its bonds

  lattice::Grid grid;                                                  ///< of the whole body
  lattice::Layout layout;                                              ///< of this rank's nodes
  std::shared_ptr<const lattice::Partition> partition;                 ///< boxes of all ranks
  std::shared_ptr<const lattice::Halo> halo;                           ///< exchange of ghost values
  material::Sharing sharing = material::Sharing::shared;               ///< how bonds get their stiffness
  material::Kinematics kinematics = material::Kinematics::rotational;  ///< where rotations come from

  lattice::Field<std::uint8_t> cell;       ///< material index of cells
  lattice::Field<std::uint8_t> bond;       ///< class of forward bonds, by slot
  std::vector<BondClass> classes;          ///< by class; class 0 is the absent bond
  std::vector<material::Springs> springs;  ///< by material index; entry 0 (empty) is zero

  /// Unknowns per node: three displacements, and three rotations with rotational kinematics.
  int components() const { return kinematics == material::Kinematics::rotational ? 6 : 3; }
  /// Whether some material has a volumetric spring.
  bool has_volumetric() const;
};

/// A lattice with its cells, not yet its bonds: `material_of(global cell)` gives the material index (0 = empty); cells
/// outside the body are empty.
SpringLattice make_cells(const lattice::Grid& grid, std::shared_ptr<const lattice::Partition> partition,
                         std::shared_ptr<const lattice::Halo> halo,
                         const std::function<std::uint8_t(const Int3&)>& material_of);

/// Bonds of the whole body by slot (collective): with plain springs each counts one, with shared springs the part of it
/// that its solid cells own. Families the unit cell lacks are counted as if they were there.
std::array<double, lattice::slot_count> count_bonds(const SpringLattice& body, material::Sharing sharing);

/// Adds the bonds. Shared springs: a bond is the sum of its cells' shares. Plain springs: the mean over its solid
/// cells. `springs` by material index, entry 0 zero. Throws InputError when the mixtures need more than max_classes
/// classes.
void make_bonds(SpringLattice& body, material::Sharing sharing, material::Kinematics kinematics,
                std::vector<material::Springs> springs);

}  // namespace koshi::model
