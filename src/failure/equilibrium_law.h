// What the driver of an equilibrium asks of a law of fracture, whatever breaks.
#pragma once

#include <functional>
#include <memory>

#include "failure/fracturing.h"
#include "mechanics/added_forces.h"

namespace koshi::failure {

/// What the cracks of a body in equilibrium carry beside its cells' springs, and which of their faces are closed.
class CrackContact {
 public:
  virtual ~CrackContact() = default;

  virtual mechanics::AddedForces& forces() = 0;
  /// Closes the faces that the state's displacements (ghosts up to date) press together and opens those that they pull
  /// apart; whether any has changed (collective).
  virtual bool look() = 0;
  /// What the forces change in the stored energy [J] at the state (collective).
  virtual double energy() const = 0;
  /// Faces that closed or opened on the straight way from the last event, or from the beginning of the step, to the
  /// present state: the work of loads on it, less half the sum of the forces before and after times the way [J]
  /// (collective).
  virtual double bend() const = 0;

  /// Calls make(), which makes the levels of a solver from the factors of the model's cells: meanwhile these are such
  /// that the levels are no softer than the body with its closed faces.
  virtual void make_levels(const std::function<void()>& make) = 0;
  /// Whether a crack has closed that the levels take for an open one (collective).
  virtual bool ask_for_levels() const = 0;
};

/// Cracks event by event. Displacements are those of the unit load, times a factor.
class EventLaw {
 public:
  virtual ~EventLaw() = default;

  /// The factor on the state's displacements (ghosts up to date) at which something happens next (collective):
  /// infinite when nothing does, or only where the body would be strained out of all proportion.
  virtual double next() = 0;
  /// Goes there: the displacements, ghosts too, and what the last event has taken on the way (collective).
  virtual void go(double factor) = 0;
  /// Softens or breaks what is at its limit now, with what is within a thousandth of it; false where no spring changes
  /// (collective). The state's time counts as the moment of what breaks.
  virtual bool soften() = 0;
  /// Goes back to the unit load, for the next solve (collective).
  virtual void unload() = 0;

  /// Which cracks are closed; to be looked at after each solve.
  virtual CrackContact& contact() = 0;
};

/// Cracks step by step: an equilibrium, and what cracks by it, sought together.
class StepLaw {
 public:
  virtual ~StepLaw() = default;

  /// A step starts from the present equilibrium (ghosts of the displacements up to date). The displacements go on as in
  /// the last step, as a guess of the next equilibrium.
  virtual void begin() = 0;
  /// Finds what the state's displacements crack (ghosts up to date): by how much of its limit the worst is beyond it.
  /// It has cracked after take(). (collective)
  virtual double look() = 0;
  virtual void take() = 0;
  /// Whether something broken has been strained to more than twice its length at the last look: the pieces fly off
  /// (collective).
  virtual bool fly() const = 0;
  /// The step ends with the present equilibrium: what cracks have taken on the way. The state's time counts as the
  /// moment of what has broken (collective).
  virtual void end() = 0;
  /// Goes back to where the step began, displacements and cracks (collective).
  virtual void undo() = 0;

  /// Which cracks are closed; to be looked at after each solve.
  virtual CrackContact& contact() = 0;
};

/// For the law that a body has, made or restored before; it, the model and the state outlive what is made. Cells or
/// bonds that are broken keep a trace of their springs from then on.
std::unique_ptr<EventLaw> follow_events(Fracturing& fracturing, model::Model& model, model::State& state);
std::unique_ptr<StepLaw> follow_steps(Fracturing& fracturing, model::Model& model, model::State& state);

}  // namespace koshi::failure
