// Broken bonds of a body in equilibrium: what they carry, which of them are closed, and what those that have broken
// last have taken (theory, section 12, "Bonds in equilibrium").
#pragma once

#include <vector>

#include "failure/bond_breaking.h"
#include "failure/equilibrium_law.h"

namespace koshi::failure {

/// What broken bonds change in the forces of whole ones. A broken bond keeps a trace of its springs, and all of its
/// normal spring while it is closed. As in BondBreaking, whose bonds these are, every rank follows all cells that touch
/// its nodes.
class BrokenBonds : public CrackContact, private mechanics::AddedForces {
 public:
  /// All are open at first. The state's face forces are zero, and those of these bonds from then on; the model's cells
  /// have factors.
  BrokenBonds(BondBreaking& breaking, model::Model& model, model::State& state);

  /// Takes the bonds that are broken by now. One that was whole is closed if the state's displacements shorten it.
  void renew();
  /// The way of bend() and energy_lost() starts from the present state, whose broken bonds are those that
  /// SpringLattice::broken has.
  void note();
  /// Energy [J] that bonds have taken from a cell that have broken since note(), by the forces on the straight way to
  /// the present state; and what they held at note().
  double energy_lost(std::int64_t cell) const;
  double energy_held(std::int64_t cell) const;
  /// Where the way started.
  const lattice::Field<double>& before() const { return before_; }
  /// Forces at the state's displacements.
  void update() { update(state_.displacement); }
  /// Whether an open bond of a cell has been strained to more than twice its length.
  bool has_parted() const;

  mechanics::AddedForces& forces() override { return *this; }
  bool look() override;
  double energy() const override;
  double bend() const override;
  /// Cells count with the share of their bonds that are whole or closed; those that hold their corners together no
  /// longer, with little.
  void make_levels(const std::function<void()>& make) override;
  bool ask_for_levels() const override;

 private:
  struct Cell {
    std::int64_t cell;
    std::uint32_t broken, closed, closed_before;  ///< bits of mechanics::cell_bonds
  };
  bool empty() const override { return cells_.empty(); }
  void update(const lattice::Field<double>& u) override;
  void add(std::int64_t j, std::int64_t k, double* const* force) const override { breaking_.add_forces(j, k, force); }
  /// Calls f(bond, D, springs that are gone) for those of these bonds of a cell.
  template <class F>
  void for_each_lost(const Cell& cell, std::uint32_t bonds, F&& f) const;
  const Cell& at(std::int64_t cell) const;
  double share_left(const Cell& cell) const;
  bool is_owned(std::int64_t n) const { return model_.layout().owns(model_.layout().place(n)); }

  BondBreaking& breaking_;
  model::Model& model_;
  model::State& state_;
  std::vector<Cell> cells_;  ///< with broken bonds, ascending
  lattice::Field<double> before_;
  std::vector<std::int64_t> soft_;  ///< cells that the levels take for soft ones, ascending
};

}  // namespace koshi::failure
