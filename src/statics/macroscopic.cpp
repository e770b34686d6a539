#include "statics/macroscopic.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <cmath>

#include "koshi/error.h"
#include "mechanics/uniform_strain.h"
#include "statics/borrowed.h"
#include "statics/static_solver.h"

namespace koshi::statics {
namespace {

using mechanics::Tensor6;

constexpr std::array<const char*, 6> names{"xx", "yy", "zz", "yz", "xz", "xy"};

// Component c of a tensor that does the work 1 on the stress of the same component.
Tensor6 unit_strain(std::size_t c) {
  Tensor6 strain{};
  strain[c] = c < 3 ? 1 : 0.5;
  return strain;
}

double size_of(const Tensor6& strain) {
  double square = 0;
  for (std::size_t c = 0; c < 6; ++c) square += (c < 3 ? 1 : 2) * strain[c] * strain[c];
  return std::sqrt(square);
}

// Mean stress is linear in the mean strain: one solve with what is given, and one with each strain that is not.
class Search {
 public:
  Search(const model::Model& model, model::State& state, const StaticOptions& options)
      : model_(model),
        state_(state),
        right_hand_side_(state.velocity),
        solver_(model, state.time, state.displacement, options),
        rounding_(mechanics::rounding_residual(model)) {}

  // Fails where loads move a part that nothing holds.
  void require_balance() {
    solver_.equilibrium().right_hand_side(right_hand_side_.data());
    solver_.free().require_balance(right_hand_side_.data());
  }

  // Displacements under the loads and prescribed motions and this mean strain; false once a stop was asked for.
  bool solve(const Tensor6& strain) {
    solver_.equilibrium().right_hand_side(right_hand_side_.data(), strain);
    return finish(strain);
  }

  // Mean stress under the strain alone: motions are held where they are prescribed.
  bool solve_alone(const Tensor6& strain) {
    state_.displacement.zero();
    mechanics::add_uniform_strain(model_, strain, state_.displacement);
    solver_.equilibrium().right_hand_side(state_.displacement, right_hand_side_.data());
    return finish(strain);
  }

  Tensor6 stress() const { return mechanics::mean_stress(model_, state_.displacement); }
  SolveReport report() const { return report_; }

 private:
  bool finish(const Tensor6& strain) {
    const int before = report_.iterations;
    const std::optional<Macroscopic> macroscopic = report_.macroscopic;
    const double seconds = report_.solve_seconds;
    report_ = solver_.solve(right_hand_side_.data(), rounding_ * size_of(strain), state_.displacement);
    report_.iterations += before;
    report_.solve_seconds += seconds;
    report_.macroscopic = macroscopic ? macroscopic : Macroscopic{};
    ++report_.macroscopic->solves;
    mechanics::add_uniform_strain(model_, strain, state_.displacement);
    return !report_.stopped;
  }

  const model::Model& model_;
  model::State& state_;
  Borrowed right_hand_side_;
  StaticSolver solver_;
  double rounding_;
  SolveReport report_;
};

// Strains of the free components that add what is missing to their stresses; column f of C is the mean stress
// under unit_strain(free[f]).
Eigen::VectorXd strains_for(const std::vector<std::size_t>& free, const Eigen::MatrixXd& C,
                            const Eigen::VectorXd& missing) {
  const Eigen::MatrixXd symmetric = 0.5 * (C + C.transpose());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(symmetric);
  Eigen::Index softest = 0;
  const double least = modes.eigenvalues().minCoeff(&softest);
  if (!(least > 1e-10 * modes.eigenvalues().maxCoeff())) {
    Eigen::Index component = 0;
    modes.eigenvectors().col(softest).cwiseAbs().maxCoeff(&component);
    throw RunError(fmt::format(
        "no mean strain leads to the mean stress asked for: the body gives way to {} without end, as one "
        "does that voids part in two; give the strain of {} instead",
        names[free[static_cast<std::size_t>(component)]], names[free[static_cast<std::size_t>(component)]]));
  }
  return symmetric.ldlt().solve(missing);
}

}  // namespace

SolveReport solve_macroscopic(const model::Model& model, model::State& state, const StaticOptions& options) {
  const model::MacroscopicDefinition& asked = *model.definition.macroscopic;
  const double factor = model::factor(asked.history, state.time);
  Tensor6 strain = mechanics::given_strain(model.definition, state.time);
  std::vector<std::size_t> free;
  for (std::size_t c = 0; c < 6; ++c)
    if (asked.stress_of(c)) free.push_back(c);

  Search search(model, state, options);
  search.require_balance();
  const auto count = static_cast<Eigen::Index>(free.size());
  if (count > 0) {
    Eigen::MatrixXd C(count, count);
    for (Eigen::Index f = 0; f < count; ++f) {
      if (!search.solve_alone(unit_strain(free[static_cast<std::size_t>(f)]))) return search.report();
      const Tensor6 stress = search.stress();
      for (Eigen::Index g = 0; g < count; ++g) C(g, f) = stress[free[static_cast<std::size_t>(g)]];
    }
    if (!search.solve(strain)) return search.report();
    const Tensor6 reached = search.stress();
    Eigen::VectorXd missing(count);
    for (Eigen::Index f = 0; f < count; ++f) {
      const std::size_t c = free[static_cast<std::size_t>(f)];
      missing[f] = factor * *asked.stress_of(c) - reached[c];
    }
    const Eigen::VectorXd found = strains_for(free, C, missing);
    for (Eigen::Index f = 0; f < count; ++f) {
      const std::size_t c = free[static_cast<std::size_t>(f)];
      strain[c] = found[f] * unit_strain(c)[c];
    }
  }
  if (!search.solve(strain)) return search.report();

  state.mean_strain = strain;
  SolveReport report = search.report();
  report.macroscopic->strain = strain;
  report.macroscopic->stress = search.stress();
  return report;
}

}  // namespace koshi::statics
