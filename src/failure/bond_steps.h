// Bonds of a body in equilibrium that break step by step: until none is beyond its limit any more (theory, section 12,
// "Bonds in equilibrium").
#pragma once

#include "failure/broken_bonds.h"
#include "failure/strained_bonds.h"

namespace koshi::failure {

/// Breaks the bonds that are strained most, then looks again.
class BondSteps : public StepLaw {
 public:
  /// `breaking` is that of the model and the state, made or restored before.
  BondSteps(BondBreaking& breaking, model::Model& model, model::State& state);

  void begin() override;
  double look() override;
  void take() override;
  bool fly() const override { return fly_; }
  void end() override;
  void undo() override;
  CrackContact& contact() override { return broken_; }

 private:
  BondBreaking& breaking_;
  model::State& state_;
  BrokenBonds broken_;
  StrainedBonds bonds_;
  lattice::Field<double> bonds_before_;  ///< State::bonds at the beginning of the step
  bool fly_ = false;
};

}  // namespace koshi::failure
