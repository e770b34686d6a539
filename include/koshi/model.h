// The model: a validated, frozen definition on the ranks of a run. Only State changes during a run.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "koshi/communicator.h"
#include "koshi/definition.h"
#include "koshi/spring_lattice.h"

namespace koshi::model {

/// One prescribed component of one owned node, `value` times the boundary's factor at the time.
struct PrescribedMotion {
  std::int64_t node = 0;      ///< index in the layout
  std::int8_t component = 0;  ///< 0 ... 5
  bool is_velocity = false;   ///< else a displacement
  double value = 0;           ///< [m], [rad] or per second
  int boundary = 0;           ///< index into Definition::boundaries
};

/// A force on one owned node.
struct NodeForce {
  std::int64_t node = 0;  ///< index in the layout
  Vec3 force{};           ///< [N], times the load's factor at the time
};

/// What a load whose profile depends on time would be with a factor of 1: nodes' shares of forces at places.
struct ProfiledForces {
  /// Part of the force at one place that one node takes.
  struct Share {
    std::size_t place = 0;  ///< in `places`
    std::size_t entry = 0;  ///< of the node in Load::forces
    Vec3 force{};           ///< [N]
  };
  std::vector<Vec3> places;   ///< where the profile is taken [m]
  std::vector<Share> shares;  ///< by entry
};

/// A load on this rank's owned nodes; body forces act on every node by its mass.
struct Load {
  std::vector<NodeForce> forces;             ///< by node; with a profile as it is at the start
  Vec3 acceleration{};                       ///< of the whole body [m/s^2]
  History history;                           ///< factor over time
  std::optional<ProfiledForces> profiled{};  ///< unset where the forces do not vary beside their history
};

/// A place on the surface of the body.
struct SurfacePlace {
  std::int64_t cell = 0;  ///< index of the solid cell that feels it
  Vec3 from_centre{};     ///< of that cell, in spacings
  double area = 0;        ///< of the surface that it stands for [m^2]
};

/// Owned nodes of a probe with their weights; the weights of all ranks add up to `total`.
struct Probe {
  ProbeDefinition definition;                          ///< name, quantity, reduction
  std::vector<std::pair<std::int64_t, double>> nodes;  ///< index in the layout, weight
  double total = 0;                                    ///< of the weights
  std::vector<Vec3> arms;                              ///< of a moment: positions of the nodes from its centre [m]
  /// Of stress or strain on surfaces: places in owned cells, which take the part of the nodes.
  std::vector<SurfacePlace> places{};
};

/// Cells cut by surfaces, all ranks.
struct CutCells {
  std::int64_t count = 0;  ///< with a part inside and a part outside
  double volume = 0;       ///< of the whole body in cells
  double left_out = 0;     ///< volume in cells of slivers that became empty
};

/// The whole problem on one rank.
struct Model {
  Definition definition;                     ///< as checked
  Communicator communicator;                 ///< of the run's ranks
  std::vector<material::Elastic> materials;  ///< by material index; entry 0 (empty) is zero
  SpringLattice lattice;                     ///< cells, bonds, springs
  /// Component 0: mass [kg]; 1 (rotational kinematics): rotational inertia [kg m^2]. Zero where there is no cell, in
  /// ghosts and padding.
  lattice::Field<double> inertia;
  /// Factors on the strength of cells, as SpringLattice::factor on their stiffness; no components where all are 1.
  lattice::Field<float> strength;
  std::vector<PrescribedMotion> motions;  ///< sorted by node, then component
  std::vector<Load> loads;                ///< by load of the definition
  std::vector<Probe> probes;              ///< by probe of the definition
  std::int64_t node_count = 0;            ///< nodes with at least one cell, all ranks
  std::int64_t cell_count = 0;            ///< solid cells, all ranks
  std::int64_t motion_count = 0;          ///< prescribed components, all ranks
  std::optional<CutCells> cut;            ///< unset where surfaces cut no cells

  int components() const { return lattice.components(); }           ///< unknowns per node, 6 or 3
  const lattice::Layout& layout() const { return lattice.layout; }  ///< of this rank's nodes
  /// Factor on the strength of the cell at index n.
  double strength_of(std::int64_t n) const {
    return strength.components() == 0 ? 1 : static_cast<double>(strength.component(0)[n]);
  }
  double volume() const {
    const double cells = cut ? cut->volume : static_cast<double>(cell_count);
    return cells * lattice.grid.d * lattice.grid.d * lattice.grid.d;
  }  ///< of the body [m^3]
};

/// Validates the definition against the grid and builds the model (collective). Throws InputError with the place of the
/// wrong key: size off the grid, empty selection, contradicting prescriptions, a body larger than the memory.
Model make_model(const Definition& definition, const Communicator& communicator);

/// Factor of a history at time t [s]: piecewise linear, constant outside, 1 when empty.
double factor(const History& history, double t);

/// Ramp times history of a boundary at time t [s].
double factor(const BoundaryDefinition& boundary, double t);

/// Memory [bytes] that a run of this definition takes on all its ranks together, beside that of the program and its
/// libraries, which depends on the machine.
double predicted_memory(const Definition& definition, int ranks);

/// Components of State::crack.
inline constexpr int crack_components = 16;

/// Among them: when the cell cracked through.
inline constexpr int crack_moment = 13;

/// Where the crack lies in its cell; infinite if no crack goes on along it.
inline constexpr int crack_offset = 15;

/// Damage from which on a cell counts as cracked through: as part of a crack's surface, in its catalogue, at a face.
inline constexpr double parted = 0.9;

/// What changes during a run. Component order: ux, uy, uz [m], rx, ry, rz [rad] (three components with least-squares).
struct State {
  lattice::Field<double> displacement;  ///< [m], [rad]
  lattice::Field<double> velocity;      ///< at t - dt/2 in explicit runs
  /// Unit quaternions w, x, y, z of the nodes; no components unless a run asks for orientations.
  lattice::Field<double> orientation;
  /// Of cells at their lowest corner: damage, largest equivalent strain, that at the onset, energy [J/m^3] at the
  /// onset, what the crack takes in all and what it has taken over that, its normal and slip (3 each), energy that it
  /// and its friction took [J], time [s] at which its damage passed `parted` (0: not, or before the run), 1 if it began
  /// by the shear limit, where its plane lies from the middle of the cell along the normal [m] (infinite where no crack
  /// goes on along it); no components unless a material can crack.
  lattice::Field<double> crack;
  /// Where bonds can break, of nodes: bits of the forward bonds that are broken, and of those that their shear broke,
  /// as SpringLattice::broken. In State::crack damage then is the share of a cell's bonds that are broken, 1 once they
  /// hold its corners together no longer; the strain is 1 in cells with broken bonds; onset to taken and slip are 0.
  lattice::Field<double> bonds;
  /// Where a material can crack, of nodes: forces of closed crack faces [N]; where bonds can break what these change in
  /// forces [N] and moments [N m]; follows from the others.
  lattice::Field<double> face_force;
  /// In the same case, of nodes: energy that loads and supports gave, and that damping took [J].
  lattice::Field<double> work;
  /// Mean strain of a periodic body (tensor components xx, yy, zz, yz, xz, xy), which the displacements have: across a
  /// period L they go on as u + E L.
  std::array<double, 6> mean_strain{};
  double peak_force = 0;  ///< largest reaction so far of the probe that analysis.stop_when looks at [N]
  double time = 0;        ///< [s]
  std::int64_t step = 0;  ///< explicit steps so far
  double time_step = 0;   ///< [s], of the run that took them; 0: none yet

  /// At rest, undeformed, at time 0.
  explicit State(const Model& model);
};

}  // namespace koshi::model
