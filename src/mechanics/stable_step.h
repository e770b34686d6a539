// The largest stable time step of explicit central differences.
#pragma once

#include "koshi/model.h"
#include "mechanics/force_kernel.h"

namespace koshi::mechanics {

struct StableStep {
  double wave;       ///< [s], d / c_p of the fastest material (N26)
  double frequency;  ///< [s], 2 / omega_max of the whole body, over sqrt(1 + alpha) with local damping
  double limit() const { return wave < frequency ? wave : frequency; }
};

/// Local damping (N27) adds alpha |F| to a force that opposes the motion, as it does at the turning points of the
/// fastest mode, so that mode feels the stiffness (1 + alpha) k and its limit shrinks by sqrt(1 + alpha).
///
/// omega_max by power iteration on the mass-scaled stiffness (collective). The estimate comes from below, within about
/// a percent: use it with a safety factor. Equal for any number of ranks.
StableStep stable_step(const model::Model& model, ForceKernel& kernel);

}  // namespace koshi::mechanics
