// Bonds of a body in motion that break one by one: after each step those that its displacements break, and what they
// change in the forces of whole bonds. (In equilibrium: bond_events.h, bond_steps.h.)
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "failure/bond_limits.h"
#include "failure/bond_rows.h"
#include "failure/fracturing.h"
#include "mechanics/cell_bonds.h"
#include "mechanics/cell_stress.h"
#include "mechanics/corner_forces.h"

namespace koshi::failure {

/// Keeps State::bonds, State::crack, State::face_force and SpringLattice::broken together. A bond breaks on the rank
/// that owns its first node; the bits are exchanged. Every rank follows all cells that touch its nodes.
class BondBreaking : public Fracturing {
 public:
  /// The model must have a material whose bonds break, springs that all belong to bonds, and rotations of the nodes.
  BondBreaking(model::Model& model, model::State& state);

  void restore() override;
  void follow(double dt) override;
  void add_forces(std::int64_t j, std::int64_t k, double* const* force) const override { forces_.add(j, k, force); }

  /// Bonds that are broken (collective).
  std::int64_t count() const;

 private:
  friend class BrokenBonds;  // of the same bonds, in equilibrium
  friend class StrainedBonds;
  friend class BondEvents;
  friend class BondSteps;
  bool breaks_here(std::int64_t n) const { return limits_[model_.lattice.cell.component(0)[n]].has_value(); }

  // Which bonds break.
  /// A bond, as its stretch and its shear over what it stands; 0 of one that holds or is broken.
  struct Strained {
    double stretch = 0, shear = 0;
  };
  Strained strained(std::int64_t n, int slot) const;
  /// Fills stretch_ and shear_ for the row of nodes (j, k).
  void look_at_row(std::int64_t j, std::int64_t k);
  /// An upper bound of what strained() gives for the bonds of the row's node i.
  double bound(std::int64_t i) const;
  void follow_row(std::int64_t j, std::int64_t k);
  void look_at(std::int64_t n);
  void break_bond(std::int64_t n, int slot, bool by_shear);
  void exchange();
  BondLimits limits_of(std::int64_t n, int slot) const;
  void take_over_ghosts();
  void mark_cells(std::int64_t n, int slot);

  // What that does to cells.
  template <class F>
  std::uint32_t of_cell(F&& of_node, std::int64_t n) const;
  /// Whether these bonds hold the eight corners of a cell together.
  static bool holds_together(std::uint32_t bonds);
  std::uint32_t bonds_of_cell(std::int64_t n) const;
  /// As SpringLattice::broken has it.
  std::uint32_t broken_before(std::int64_t n) const;
  std::uint32_t broken_now(std::int64_t n, int component = 0) const;
  std::uint32_t fresh(std::int64_t n) const { return broken_now(n) & ~broken_before(n); }
  void break_in_cell(std::int64_t n, double energy);
  void describe(std::int64_t n);
  void make_lattice_follow();

  // Forces and energies (bond_forces.cpp).
  double energy_lost(std::int64_t n, std::uint32_t bonds, double dt) const;
  double closing_loss(std::int64_t n, double dt) const;
  double stored_energy(std::int64_t n) const override;
  void clear_forces();
  void add_up_forces();

  mechanics::CornerForces forces_;                             ///< State::face_force
  std::vector<std::optional<BondLimits>> limits_;              ///< by material index
  std::array<std::vector<Int3>, lattice::slot_count> around_;  ///< cells around a bond, from its first node
  std::vector<BondSlot> slots_;                                ///< those with springs
  BondRows bond_rows_;
  std::vector<double> stretch_, shear_;  ///< of a row
  BondLimits least_;                     ///< of all bonds
  std::vector<char> breakable_;          ///< rows of owned nodes with bonds that can break
  std::vector<std::int64_t> cracked_;    ///< cells with broken bonds, ascending
  bool news_ = false;                    ///< a bond has broken in this step
};

}  // namespace koshi::failure
