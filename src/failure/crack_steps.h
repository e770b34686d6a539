// Cracks of a body in equilibrium, step by step: the damage that goes with the strains of a step's equilibrium (theory,
// section 12, "In steps").
#pragma once

#include <optional>
#include <vector>

#include "failure/closed_faces.h"
#include "mechanics/cell_stress.h"

namespace koshi::failure {

/// Damage of a model's cells from one equilibrium to the next, sought together with the second. As in Cracking, whose
/// cells these are, every rank follows all cells that touch its nodes.
class CrackSteps : public StepLaw {
 public:
  /// `cracking` is that of the model and the state, made or restored before. Closed cracks carry what contact() says
  /// from then on, and cells that have cracked through keep a trace of their springs, which holds the nodes on them.
  CrackSteps(Cracking& cracking, model::Model& model, model::State& state);

  void begin() override;
  /// Finds the damage that the displacements ask for, beginning with that before the step.
  double look() override;
  void take() override;
  bool fly() const override { return fly_; }
  void end() override;
  void undo() override;
  ClosedFaces& contact() override { return faces_; }

 private:
  struct Followed {
    std::int64_t cell;
    Crack before;    ///< at the beginning of the step; kappa = 0: it had none
    Crack next{};    ///< as of the last look
    double off = 0;  ///< at the last look: damage asked for beyond that of the cell, times its stress over its strength
    double off_before = 0;  ///< at the look before
  };
  void look(Followed& cell);
  void seek(std::int64_t j, std::int64_t k);
  void stretch();
  double energy_lost(const Followed& cell, const Tensor6& strain, const Vec3& normal) const;
  double strain_before(std::int64_t n, const Vec3& normal) const;

  Cracking& cracking_;
  model::Model& model_;
  model::State& state_;
  ClosedFaces faces_;
  lattice::Field<double> start_;    ///< displacements at the beginning of the step
  std::vector<Followed> followed_;  ///< cells that have a crack, or had one at some look of the step; ascending
  double stretch_ = 1;              ///< of the changes of damage that looks ask for
  bool fly_ = false;
};

}  // namespace koshi::failure
