// Work of loads and supports through load steps.
#pragma once

#include "koshi/model.h"
#include "mechanics/loads.h"
#include "mechanics/measure.h"

namespace koshi::driver {

/// Joins the equilibria at the ends of steps by straight lines of forces over displacements.
class StepWork {
 public:
  /// Starts from a body at rest without forces. Model and meter must outlive this.
  StepWork(const model::Model& model, mechanics::Meter& meter);

  /// The state is the equilibrium at the end of a step; what it took from loads and supports since the start [J]
  /// (collective). `bend`: CrackContact::bend() of the step.
  double add(model::State& state, double bend);

 private:
  const model::Model& model_;
  mechanics::Meter& meter_;
  mechanics::LoadRows loads_;
  lattice::Field<double> force_, displacement_;  ///< at the end of the last step
  double work_ = 0;
};

}  // namespace koshi::driver
