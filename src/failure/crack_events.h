// Cracks of a body in equilibrium, event by event: at which load the next cells crack, how they soften there, and the
// energy that takes (theory, section 12, "In equilibrium").
#pragma once

#include <vector>

#include "failure/closed_faces.h"
#include "failure/load_factor.h"

namespace koshi::failure {

/// Softens the cells of a model one group at a time, in steps of their stiffness. As in Cracking, whose cells these
/// are, every rank follows all cells that touch its nodes. Displacements are those of the unit load, times a factor.
class CrackEvents : public EventLaw {
 public:
  /// `cracking` is that of the model and the state, made or restored before. Closed cracks carry what contact() says
  /// from then on, and cells that have cracked through keep a trace of their springs, which holds the nodes on them.
  CrackEvents(Cracking& cracking, model::Model& model, model::State& state);

  double next() override;
  void go(double factor) override;
  /// False where a crack has only come to the end of its energy.
  bool soften() override;
  void unload() override { load_.unload(); }
  ClosedFaces& contact() override { return faces_; }

 private:
  /// A cell that lost springs at the last event: the energy of that is known at the next one.
  struct Loss {
    std::int64_t cell;
    double damage;                 ///< lost
    mechanics::CellMotion motion;  ///< at the event
    double pressed;                ///< strain across the crack at the event, if that pressed it, else 0
    double gain = 0;               ///< energy [J/m^3] that this takes, for each unit of the next event's factor
  };
  struct Candidate {
    std::int64_t cell;
    double factor;
  };
  void consider(std::int64_t n, double factor);
  void consider_row(std::int64_t j, std::int64_t k);
  double gain(const Loss& loss) const;
  double factor_of_cracked(std::int64_t n) const;
  void soften(std::int64_t n);

  Cracking& cracking_;
  model::Model& model_;
  model::State& state_;
  ClosedFaces faces_;
  std::vector<Loss> losses_;  ///< ascending
  std::vector<Candidate> candidates_;
  double least_ = 0;    ///< factor of the first candidate
  double largest_ = 0;  ///< radius of the strain's deviator among whole cells
  LoadFactor load_;
};

}  // namespace koshi::failure
