// The mean strain of a periodic body in motion.
#pragma once

#include "koshi/model.h"

namespace koshi::dynamics {

/// Strains a periodic body as the definition's [macroscopic] says, docs/theory/14_effective_stiffness.md (14.6): every
/// node follows E x at once, and what moves by the laws of motion is the rest of its displacement. A body without
/// [macroscopic] is left alone.
class MeanStrain {
 public:
  /// Takes the strain of the state's time as the one that its displacements hold.
  MeanStrain(const model::Model& model, model::State& state);

  /// Gives the displacements the strain of the state's time in place of the one they hold.
  void follow();
  /// Gives ghosts across a period, which hold the displacements of their originals, those of the next image.
  void continue_ghosts();

 private:
  const model::Model& model_;
  model::State& state_;
};

}  // namespace koshi::dynamics
