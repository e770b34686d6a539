// Closed cracks of a body in equilibrium: which they are, and the pressure that they carry (theory, section 12,
// "Pressure across cracks").
#pragma once

#include <vector>

#include "failure/cracking.h"
#include "failure/equilibrium_law.h"
#include "mechanics/face_springs.h"

namespace koshi::failure {

/// Springs across the cracks of a model that are closed. As in Cracking, whose cells these are, every rank follows all
/// cells that touch its nodes.
class ClosedFaces : public CrackContact {
 public:
  /// All are open at first. The state's face forces are zero, and those of these springs from then on.
  ClosedFaces(const Cracking& cracking, model::Model& model, model::State& state);

  mechanics::AddedForces& forces() override { return springs_; }
  bool look() override;
  /// Whether the cell counts on this rank.
  bool is_owned(std::int64_t n) const;
  /// Takes the damage of cells as it is now.
  void restore();
  mechanics::FaceSprings& springs() { return springs_; }

  /// Strain across a closed crack, n.eps.n of the state; 0 where the cell's crack is open.
  double pressed(std::int64_t cell) const;
  double energy() const override;

  /// Keeps the strains of all cracks and what springs they have when closed, for bend(); and of one more cell, which
  /// has cracked since and had none.
  void note();
  void note(std::int64_t fresh);
  /// The same of a cell whose crack is strained by this across its normal at note().
  void note(std::int64_t fresh, double strain);
  /// From note() on.
  double bend() const override;

  /// Closed cells count as whole ones in the levels.
  void make_levels(const std::function<void()>& make) override;
  bool ask_for_levels() const override;

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
