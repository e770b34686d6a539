// What the explicit solver, the driver and the meter ask of a law of fracture.
#pragma once

#include "koshi/model.h"
#include "mechanics/measure.h"

namespace koshi::failure {

/// Follows the cracks of a body step by step, in State::crack and what follows from it.
class Fracturing {
 public:
  /// Components of State::crack.
  enum Part {
    damage = 0,
    kappa,
    limit,
    onset,
    ratio,
    taken,
    normal,
    slip = normal + 3,
    dissipated = slip + 3,
    moment,
    shear,
    offset
  };
  static_assert(offset + 1 == model::crack_components && moment == model::crack_moment &&
                offset == model::crack_offset);

  /// Stiffness that broken cells and bonds keep in equilibrium, over that of whole ones. Nodes between them hang on it.
  static constexpr double trace = 1e-6;

  virtual ~Fracturing() = default;

  /// What follows from the state: at the start, and after it was changed by others (collective).
  virtual void restore() = 0;

  /// Cracks what the state's displacements crack. Ghosts of displacement and velocity must be up to date; dt: the step
  /// [s] that led there, by the state's velocities. Takes no memory (collective).
  virtual void follow(double dt) = 0;

  /// May be called for a row of owned nodes in a step, once its velocities are those of the step and while they are in
  /// the cache: follow() then need not read them again.
  virtual void note_row(std::int64_t /*j*/, std::int64_t /*k*/) {}

  /// To be called when displacements were changed in another way than by the steps that follow() is told of; a law that
  /// looks at all of the body in each step has nothing to do.
  virtual void look_again() {}

  /// Adds what cracks change in the forces on row (j, k), force[c] pointing to node i = 0.
  virtual void add_forces(std::int64_t j, std::int64_t k, double* const* force) const = 0;

  /// To be called before State::face_force is read: a law may leave it behind from step to step.
  virtual void lay_forces() {}

  /// Cells that have cracked with at least this damage (collective).
  std::int64_t count_cells(double at_least) const;

  /// Energy [J] that cracks and the friction of their faces have taken so far (collective).
  double energy_taken() const;

  /// Adds to a balance of the state what cracks change in the stored energy, and where energy has gone (collective).
  void complete(mechanics::Balance& balance) const;

 protected:
  /// Cells are looked at a little below their limit, and bonds, so that how the first look was rounded does not matter.
  static constexpr double margin = 1 - 1e-5;

  Fracturing(model::Model& model, model::State& state) : model_(model), state_(state) {}

  /// What the cracks of an owned cell change in the stored energy [J].
  virtual double stored_energy(std::int64_t n) const = 0;

  model::Model& model_;
  model::State& state_;
};

}  // namespace koshi::failure
