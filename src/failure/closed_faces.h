// Closed cracks of a body in equilibrium: which they are, and the pressure that they carry (theory, section 12,
// "Pressure across cracks").
#pragma once

#include <utility>
#include <vector>

#include "failure/cracking.h"
#include "mechanics/face_springs.h"

namespace koshi::failure {

/// Springs across the cracks of a model that are closed. As in Cracking, whose cells these are, every rank follows all
/// cells that touch its nodes.
class ClosedFaces {
 public:
  /// All are open at first. The state's face forces are zero, and those of these springs from then on.
  ClosedFaces(const Cracking& cracking, model::Model& model, model::State& state);

  /// Closes the cracks that the state's displacements (ghosts up to date) press together and opens those that they pull
  /// apart; whether any has changed (collective).
  bool look();
  /// Whether the cell counts on this rank.
  bool is_owned(std::int64_t n) const;
  /// Takes the damage of cells as it is now.
  void restore();
  mechanics::FaceSprings& springs() { return springs_; }

  /// Strain across a closed crack, n.eps.n of the state; 0 where the cell's crack is open.
  double pressed(std::int64_t cell) const;
  /// Energy of all these springs [J] at the state (collective).
  double energy() const;

  /// Keeps the strains of all cracks and what springs they have when closed, for bend(); and of one more cell, which
  /// has cracked since and had none.
  void note();
  void note(std::int64_t fresh);
  /// The same of a cell whose crack is strained by this across its normal at note().
  void note(std::int64_t fresh, double strain);
  /// Cracks that closed or opened on the straight way from the state at note() to that at present: the work of loads on
  /// it, less half the sum of the forces before and after times the way [J] (collective).
  double bend() const;

  /// Calls make(), which makes the levels of a solver: closed cells count as whole ones meanwhile.
  template <class F>
  void make_levels(F&& make) {
    std::vector<float> factors;
    for (const mechanics::FaceSpring& spring : springs_.springs())
      factors.push_back(std::exchange(factor(spring.cell), cracking_.whole_.component(0)[spring.cell]));
    make();
    std::size_t next = 0;
    for (const mechanics::FaceSpring& spring : springs_.springs()) factor(spring.cell) = factors[next++];
    levels_are_made();
  }
  /// The levels are those of the present factors.
  void levels_are_made();
  /// Whether a crack has closed that the levels take for an open one (collective).
  bool ask_for_levels() const;

 private:
  struct Noted {
    std::int64_t cell;
    double strain, stiffness;
  };
  bool is_closed(std::int64_t n) const;
  mechanics::FaceSpring spring(std::int64_t n) const;
  float& factor(std::int64_t n) { return model_.lattice.factor.component(0)[n]; }

  const Cracking& cracking_;
  model::Model& model_;
  model::State& state_;
  mechanics::FaceSprings springs_;
  std::vector<Noted> noted_;
  std::vector<std::int64_t> soft_;  ///< open cells in the levels, ascending
};

}  // namespace koshi::failure
