// Where the energy of a motion goes: work of loads and supports, and damping, node by node.
#pragma once

#include <vector>

#include "dynamics/row_update.h"
#include "koshi/model.h"
#include "mechanics/loads.h"

namespace koshi::dynamics {

/// Adds to State::work what one row of nodes gets in a step of dt [s]. Displacements move on by dt (v + v')/2 around
/// the moment of the forces, v and v' the velocities before and after: forces times that is what central differences
/// gain. What damping takes is counted as the row is kicked; velocities are kept only of rows with loads or supports.
class EnergyLedger {
 public:
  EnergyLedger(const model::Model& model, model::State& state, const mechanics::RowIndex& motion_rows, const Kick& kick,
               double dt);

  /// Before loads are added to the forces of row (j, k), if there are any, and its velocities change.
  void open(std::int64_t j, std::int64_t k, double* const* force, bool loaded);
  /// Kicks component c of the row that begins with node n.
  void kick(int c, std::int64_t n, const double* force, const double* inverse_inertia);
  /// After both, and after supports have set their velocities; `force` with loads.
  void close(std::int64_t j, std::int64_t k, double* const* force);

  /// What a step will write on the line of nodes at n may be fetched into the cache.
  void fetch(std::int64_t n) const {
    if (damping_) __builtin_prefetch(state_.work.component(damped) + n, 1, 2);
  }

 private:
  /// Parts of State::work.
  enum Part { given = 0, damped = 1 };

  double inertia(int c, std::int64_t n) const { return model_.inertia.component(c < 3 ? 0 : 1)[n]; }
  double damped_in_free(std::size_t first, std::size_t end, std::int64_t i, double* const* force) const;

  const model::Model& model_;
  model::State& state_;
  const mechanics::RowIndex& motion_rows_;
  Kick kick_;
  double dt_;
  bool damping_;
  const RowUpdate& update_ = row_update();
  bool loaded_ = false;                                     ///< the row, with more than its springs
  bool supported_ = false;                                  ///< the row has prescribed components
  std::array<std::vector<double>, 6> internal_, velocity_;  ///< of a loaded or supported row, before
  std::vector<double> damped_;                              ///< of a supported row, before
};

}  // namespace koshi::dynamics
