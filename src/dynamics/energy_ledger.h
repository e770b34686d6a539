// Where the energy of a motion goes: work of loads and supports, and damping, node by node.
#pragma once

#include <vector>

#include "dynamics/row_update.h"
#include "koshi/model.h"
#include "mechanics/loads.h"

namespace koshi::dynamics {

/// Adds to State::work what one row of nodes gets in a step of dt [s]. Displacements move on by dt (v + v')/2 around
/// the moment of the forces, v and v' the velocities before and after: forces times that is what central differences
/// gain.
class EnergyLedger {
 public:
  EnergyLedger(const model::Model& model, model::State& state, const mechanics::RowIndex& motion_rows, double dt);

  /// Before loads are added to the forces of row (j, k), if there are any, and its velocities change.
  void open(std::int64_t j, std::int64_t k, double* const* force, bool loaded);
  /// After both; `force` with loads.
  void close(std::int64_t j, std::int64_t k, double* const* force);

 private:
  /// Parts of State::work.
  enum Part { given = 0, damped = 1 };

  const model::Model& model_;
  model::State& state_;
  const mechanics::RowIndex& motion_rows_;
  double dt_;
  bool damping_;
  const RowUpdate& update_ = row_update();
  bool loaded_ = false;                                     ///< the row, with more than its springs
  std::array<std::vector<double>, 6> internal_, velocity_;  ///< of the row, before
};

}  // namespace koshi::dynamics
