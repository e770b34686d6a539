#include "statics/ending.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace koshi::statics {
namespace {

// Contrast of stiffness up to which a stiff bar that hangs on a soft one reaches a residual of 1e-8.
constexpr double most_contrast = 1e8;

// The residuals of at most a dozen iterations, the last one among them.
std::string history_text(const std::vector<double>& history) {
  constexpr std::size_t shown = 12;
  std::string text;
  const std::size_t step = (history.size() + shown - 1) / shown;
  for (std::size_t i = 0; i < history.size(); ++i)
    if ((history.size() - 1 - i) % step == 0)
      text += fmt::format("{}{}: {:.1e}", text.empty() ? "" : ", ", i, history[i]);
  return text;
}

std::string hint(KSPConvergedReason reason, const std::vector<double>& history, double ratio) {
  const double least = history.empty() ? 1 : *std::min_element(history.begin(), history.end());
  if (reason == KSP_DIVERGED_NANORINF) return "check loads and units";
  // A stiff part moves by what the soft one gives; rounding of that motion is a force of its own stiffness.
  if (ratio >= most_contrast)
    return fmt::format(
        "the stiffest cell has {:.0e} times the stiffness of the softest, and where the soft one carries the load "
        "rounding ends what can be reached: about {:.0e} is always solved; make the softest stiffer, or void",
        ratio, most_contrast);
  if (reason == KSP_DIVERGED_INDEFINITE_MAT || reason == KSP_DIVERGED_INDEFINITE_PC)
    return "some motion of the body costs no energy or releases it; `koshi check` says what the springs can hold";
  if (least < 1e-12) return "rounding ends what can be reached; take a tolerance of 1e-11 or more";
  return "allow more iterations (-- -ksp_max_it 2000) or a larger analysis.tolerance; parts that hang together by "
         "single nodes or by very soft material converge slowly";
}

}  // namespace

double contrast(const model::Model& model) {
  double least = std::numeric_limits<double>::infinity(), most = 0;
  const model::SpringLattice& body = model.lattice;
  lattice::for_each(body.layout, {0, 0, 0}, body.layout.owned(), [&](auto, auto, auto, auto n) {
    const double modulus = model.materials[body.cell.component(0)[n]].youngs_modulus * body.factor_of(n);
    if (modulus > 0) least = std::min(least, modulus);
    most = std::max(most, modulus);
  });
  return model.communicator.max(most) / model.communicator.min(least);
}

std::string end_in_words(KSPConvergedReason reason) {
  switch (reason) {
    case KSP_CONVERGED_RTOL:
      return "relative residual below the tolerance";
    case KSP_CONVERGED_ATOL:
      return "residual of rounding size";
    case KSP_CONVERGED_ITS:
      return "number of iterations";
    case KSP_DIVERGED_ITS:
      return "more of them are needed";
    case KSP_DIVERGED_DTOL:
      return "the residual grows";
    case KSP_DIVERGED_NANORINF:
      return "numbers overflowed";
    case KSP_DIVERGED_INDEFINITE_MAT:
    case KSP_DIVERGED_INDEFINITE_PC:
      return "the stiffness is not positive";
    default:
      return reason > 0 ? "the iteration came to its end" : "the iteration broke down";
  }
}

RunError no_equilibrium(const model::Model& model, const SolveReport& report, KSPConvergedReason reason) {
  const std::vector<std::string>& unused = report.unused_options;
  return RunError(fmt::format("no equilibrium found in {} iterations: {}; relative residual by iteration: {}; {}{}",
                              report.iterations, end_in_words(reason), history_text(report.residual_history),
                              hint(reason, report.residual_history, contrast(model)),
                              unused.empty() ? "" : fmt::format("; not used: {}", fmt::join(unused, " "))));
}

}  // namespace koshi::statics
