// Why the iterations of an equilibrium ended, in words of the field; nothing of the library's reaches the user.
#pragma once

#include <petscksp.h>

#include <string>

#include "koshi/error.h"
#include "koshi/model.h"
#include "koshi/statics.h"

namespace koshi::statics {

/// Young's modulus of the stiffest cell over that of the softest, factors included; cells without stiffness are voids
/// (collective).
double contrast(const model::Model& model);

/// "relative residual below the tolerance", "the residual grows" and the like.
std::string end_in_words(KSPConvergedReason reason);

/// The error of a solve that did not converge: residuals by iteration, and what to change (collective).
RunError no_equilibrium(const model::Model& model, const SolveReport& report, KSPConvergedReason reason);

}  // namespace koshi::statics
