// What is measured on a state: balance, energies, probes.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "koshi/model.h"
#include "mechanics/force_kernel.h"
#include "mechanics/loads.h"
#include "mechanics/surface_stress.h"

namespace koshi::mechanics {

/// Sums over the body, equal on all ranks and for any number of ranks.
struct Balance {
  double elastic_energy = 0;  ///< [J], -u.F/2, and what a mean strain adds
  double kinetic_energy = 0;  ///< [J], at the time of the displacements
  /// [J], what central differences conserve instead of the sum of both, see docs/theory/04_motion.md (4.1).
  double leapfrog_energy = 0;
  double residual = 0;   ///< [N], root of the sum of squares of forces (and moments/d) on free components
  double reference = 0;  ///< [N], the same of loads and reactions, and of a mean stress on the box
  // Where cells can crack, since the start:
  double given = 0;        ///< [J], work of loads and supports
  double damped = 0;       ///< [J], taken by damping
  double cracked = 0;      ///< [J], taken by cracks and the friction of their faces
  double load_factor = 1;  ///< on loads and prescribed motions, where an equilibrium follows its cracks

  /// Unbalanced-force ratio, residual / reference; 0 for a body without any force.
  double unbalanced_ratio() const { return residual == 0 ? 0 : reference > 0 ? residual / reference : 1; }
};

/// Values of one probe: 1, 3 or 6 components, SI.
using ProbeValue = std::vector<double>;

/// A periodic body as a whole.
struct MeanState {
  Tensor6 strain{};  ///< zero where the body has no periods
  Tensor6 stress{};  ///< over the box, voids too [Pa]
};

struct Measurement {
  Balance balance;
  std::vector<ProbeValue> probes;   ///< by probe
  std::optional<MeanState> mean{};  ///< of a body with a macroscopic strain
};

/// Balance and probes at the state's time (collective). `dt`: the step whose midpoint velocities the state holds (0:
/// they belong to the state's own time).
class Meter {
 public:
  Meter(const model::Model& model, ForceKernel& kernel);
  Measurement measure(model::State& state, double dt);
  Balance balance(model::State& state, double dt);
  /// Reactions [N], [N m] on prescribed components, and of surfaces that hold the body unless they are not asked for
  /// (`ground`); zero elsewhere (collective).
  lattice::Field<double> reactions(model::State& state, bool ground = true);

 private:
  /// Calls f(j, k, forces) for every row.
  template <class F>
  void for_each_row(model::State& state, F&& f);
  /// Forces of the ground on row (j, k), by component to node i = 0; null: none.
  double* const* ground_row(std::int64_t j, std::int64_t k);
  ProbeValue probe_value(const model::Probe& probe, const model::State& state,
                         const std::vector<std::array<double, 6>>& node_reactions) const;

  const model::Model& model_;
  ForceKernel& kernel_;
  LoadRows loads_;
  RowIndex motion_rows_;
  std::optional<SurfaceStress> surface_;  ///< of probes with places on surfaces
  std::array<std::vector<double>, 3> ground_;
  std::array<double*, 3> ground_row_{};
};

/// Component names of a probe's quantity: {"x", "y", "z"}, {"xx", ...}; a unit for each quantity.
std::vector<std::string> component_names(model::ProbeDefinition::Quantity quantity);
std::string unit_of(model::ProbeDefinition::Quantity quantity);
std::string name_of(model::ProbeDefinition::Quantity quantity);

}  // namespace koshi::mechanics
