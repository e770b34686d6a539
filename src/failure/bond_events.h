// Bonds of a body in equilibrium that break event by event: at which load the next ones do, and the energy that takes
// (theory, section 12, "Bonds in equilibrium").
#pragma once

#include "failure/broken_bonds.h"
#include "failure/load_factor.h"
#include "failure/strained_bonds.h"

namespace koshi::failure {

/// Breaks bonds one by one, those that tie together. Each that breaks gives two events: one at which it breaks, one to
/// which the load has fallen then.
class BondEvents : public EventLaw {
 public:
  /// `breaking` is that of the model and the state, made or restored before.
  BondEvents(BondBreaking& breaking, model::Model& model, model::State& state);

  double next() override;
  void go(double factor) override;
  bool soften() override;
  void unload() override { load_.unload(); }
  CrackContact& contact() override { return broken_; }

 private:
  double spread() const;

  BondBreaking& breaking_;
  model::Model& model_;
  model::State& state_;
  BrokenBonds broken_;
  StrainedBonds bonds_;
  bool breaks_ = false;  ///< what next() has found is a bond that breaks
  LoadFactor load_;
};

}  // namespace koshi::failure
