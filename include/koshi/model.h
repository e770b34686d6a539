// The model: a validated, frozen definition on the ranks of a run. Only State changes during a run.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "koshi/communicator.h"
#include "koshi/definition.h"
#include "koshi/spring_lattice.h"

namespace koshi::model {

/// One prescribed component of one owned node, `value` times the boundary's factor at the time.
struct PrescribedMotion {
  std::int64_t node = 0;
  std::int8_t component = 0;  ///< 0 ... 5
  bool is_velocity = false;
  double value = 0;  ///< [m], [rad] or per second
  int boundary = 0;  ///< index into Definition::boundaries
};

struct NodeForce {
  std::int64_t node = 0;
  Vec3 force{};  ///< [N], times the load's factor at the time
};

/// A load on this rank's owned nodes; body forces act on every node by its mass.
struct Load {
  std::vector<NodeForce> forces;
  Vec3 acceleration{};  ///< [m/s^2]
  History history;
};

/// Owned nodes of a probe with their weights; the weights of all ranks add up to `total`.
struct Probe {
  ProbeDefinition definition;
  std::vector<std::pair<std::int64_t, double>> nodes;
  double total = 0;
  std::vector<Vec3> arms;  ///< of a moment: positions of the nodes from its centre [m]
};

struct Model {
  Definition definition;
  Communicator communicator;
  std::vector<material::Elastic> materials;  ///< by material index; entry 0 (empty) is zero
  SpringLattice lattice;
  /// Component 0: mass [kg]; 1 (rotational kinematics): rotational inertia [kg m^2]. Zero where there is no cell, in
  /// ghosts and padding.
  lattice::Field<double> inertia;
  std::vector<PrescribedMotion> motions;  ///< sorted by node, then component
  std::vector<Load> loads;
  std::vector<Probe> probes;
  std::int64_t node_count = 0;    ///< nodes with at least one cell, all ranks
  std::int64_t cell_count = 0;    ///< solid cells, all ranks
  std::int64_t motion_count = 0;  ///< prescribed components, all ranks

  int components() const { return lattice.components(); }
  const lattice::Layout& layout() const { return lattice.layout; }
  double volume() const { return static_cast<double>(cell_count) * lattice.grid.d * lattice.grid.d * lattice.grid.d; }
};

/// Validates the definition against the grid and builds the model (collective). Throws InputError with the place of the
/// wrong key: size off the grid, empty selection, contradicting prescriptions, a body larger than the memory.
Model make_model(const Definition& definition, const Communicator& communicator);

/// Factor of a history at time t [s]: piecewise linear, constant outside, 1 when empty.
double factor(const History& history, double t);

/// Ramp times history of a boundary at time t [s].
double factor(const BoundaryDefinition& boundary, double t);

/// Memory [bytes] that a run of this definition needs on all its ranks together.
double predicted_memory(const Definition& definition, int ranks);

/// What changes during a run. Component order: ux, uy, uz [m], rx, ry, rz [rad] (three components with least-squares).
struct State {
  lattice::Field<double> displacement;
  lattice::Field<double> velocity;  ///< at t - dt/2 in explicit runs
  /// Unit quaternions w, x, y, z of the nodes; no components unless a run asks for orientations.
  lattice::Field<double> orientation;
  double time = 0;  ///< [s]
  std::int64_t step = 0;

  explicit State(const Model& model)
      : displacement(model.layout(), model.components()), velocity(model.layout(), model.components()) {}
};

}  // namespace koshi::model
