#include "koshi/error.h"
#include "koshi/statics.h"

namespace koshi::statics {

SolveReport solve_static(const model::Model&, model::State&, const StaticOptions&) {
  throw RunError("this version has no direct equilibrium; use analysis.type = \"quasi-static\"");
}

}  // namespace koshi::statics
