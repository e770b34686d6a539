#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <optional>

#include "base/exact_sum.h"
#include "homogenize/bounds.h"
#include "homogenize/cells.h"
#include "homogenize/held.h"
#include "homogenize/mixed_phases.h"
#include "homogenize/phase_sums.h"
#include "homogenize/structure.h"
#include "koshi/error.h"
#include "mechanics/uniform_strain.h"
#include "statics/mixed_gradients.h"
#include "statics/static_solver.h"

namespace koshi::homogenize {
namespace {

using Matrix = std::array<std::array<double, 6>, 6>;

// Volumes of the materials, and the mean density.
void count_phases(const model::Model& model, Effective& effective) {
  const model::SpringLattice& body = model.lattice;
  std::vector<std::int64_t> count(model.materials.size());
  for_each_cell(model, [&](std::int64_t n) { ++count[body.cell.component(0)[n]]; });
  // The masses of the nodes are those of their cells, partly filled ones too.
  ExactSum mass;
  lattice::for_each_owned(body.layout, [&](auto, auto, auto, auto n) { mass += model.inertia.component(0)[n]; });
  mass.sum_ranks(model.communicator);
  model.communicator.sum(count);
  const auto cells = static_cast<double>(body.grid.cell_count());
  for (std::size_t m = 0; m < count.size(); ++m) {
    if (count[m] == 0) continue;
    const double fraction = static_cast<double>(count[m]) / cells;
    effective.phases.push_back({static_cast<std::uint16_t>(m), fraction});
  }
  effective.density = mass.value() / (cells * std::pow(body.grid.d, 3));
}

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix c{};
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j)
      for (std::size_t k = 0; k < 6; ++k) c[i][j] += a[i][k] * b[k][j];
  return c;
}

// The matrix made symmetric, and how far it was from that; `difference`: of entries that were made equal before.
Matrix symmetric(const Matrix& whole, double difference, double& asymmetry) {
  double largest = 0;
  Matrix result;
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j) {
      largest = std::max(largest, std::abs(whole[i][j]));
      difference = std::max(difference, std::abs(whole[i][j] - whole[j][i]));
      result[i][j] = (whole[i][j] + whole[j][i]) / 2;
    }
  asymmetry = largest > 0 ? difference / largest : 0;
  return result;
}

// Equilibrium under mean strains: in single precision where that serves, else by PETSc's solver.
class StrainSolver {
 public:
  StrainSolver(const model::Model& model, const statics::StaticOptions& options) : model_(model) {
    if (statics::MixedGradients::serves(model, options)) {
      mixed_.emplace(model, options);
      return;
    }
    work_ = lattice::Field<double>(model.layout(), model.components());
    right_hand_side_.resize(static_cast<std::size_t>(model.layout().owned_count() * model.components()));
    double_.emplace(model, 0, work_, options);
  }

  // Fills u, ghosts too.
  statics::SolveReport solve(const mechanics::Tensor6& strain, double rounding, lattice::Field<double>& u) {
    if (mixed_) return mixed_->solve(strain, rounding, u);
    // The springs push the uniform strain out of balance; what is added to it restores it.
    u.zero();
    mechanics::add_uniform_strain(model_, strain, u);
    double_->equilibrium().right_hand_side(u, right_hand_side_.data());
    const statics::SolveReport report = double_->solve(right_hand_side_.data(), rounding, u);
    mechanics::add_uniform_strain(model_, strain, u);
    return report;
  }

  // Whether a solve ends by the energy of its error, and the two below serve.
  bool by_energy() const { return mixed_.has_value(); }
  statics::ByteField kept(const mechanics::Tensor6& strain, const lattice::Field<double>& u) const {
    return mixed_->kept(strain, u);
  }
  double work(const statics::ByteField& kept) const { return mixed_->work(kept); }

 private:
  const model::Model& model_;
  std::optional<statics::MixedGradients> mixed_;
  lattice::Field<double> work_;
  std::vector<double> right_hand_side_;
  std::optional<statics::StaticSolver> double_;
};

// Columns of C: mean stresses under the mean strains. Returns the largest difference of opposite entries that it made
// equal [Pa].
double solve_strains(const model::Model& model, const std::vector<std::size_t>& cases,
                     const statics::StaticOptions& options, Effective& effective, Matrix& whole, PhaseSums& means) {
  StrainSolver solver(model, options);
  const double rounding = mechanics::rounding_residual(model);
  lattice::Field<double> u(model.layout(), model.components());
  std::vector<statics::ByteField> kept;
  double difference = 0;
  for (const std::size_t j : cases) {
    mechanics::Tensor6 strain{};
    strain[j] = j < 3 ? 1 : 0.5;
    effective.cases[j] = solver.solve(strain, rounding, u);
    if (effective.cases[j].stopped) throw RunError("stopped before the six load cases were solved");
    const mechanics::Tensor6 stress = means.add(j, u);
    for (std::size_t i = 0; i < 6; ++i) whole[i][j] = stress[i];
    // C_ij = u_i . K u_j / V has an error of second order; Sigma_ij lacks the work of the residual on the other case.
    const double volume = static_cast<double>(model.lattice.grid.cell_count()) * std::pow(model.lattice.grid.d, 3);
    if (!solver.by_energy()) continue;
    for (std::size_t earlier = 0; earlier < kept.size(); ++earlier) {
      const std::size_t i = cases[earlier];
      whole[i][j] -= solver.work(kept[earlier]) / volume;
      difference = std::max(difference, std::abs(whole[i][j] - whole[j][i]));
      whole[j][i] = whole[i][j];
    }
    if (j != cases.back()) kept.push_back(solver.kept(strain, u));
  }
  return difference;
}

// C as the inverse of the mean strains under the forces of uniform stresses.
void solve_stresses(const model::Model& model, const statics::StaticOptions& options, Effective& effective,
                    PhaseSums& means) {
  lattice::Field<double> u(model.layout(), model.components());
  std::vector<double> right_hand_side(static_cast<std::size_t>(model.layout().owned_count() * model.components()));
  statics::StaticSolver solver(model, 0, u, options);
  Matrix compliance{};
  for (std::size_t j = 0; j < 6; ++j) {
    surface_forces(model, j, right_hand_side.data());
    effective.cases[j] = solver.solve(right_hand_side.data(), 0, u);
    if (effective.cases[j].stopped) throw RunError("stopped before the six load cases were solved");
    const mechanics::Tensor6 strain = surface_strain(model, u);
    for (std::size_t i = 0; i < 6; ++i) compliance[i][j] = (i < 3 ? 1 : 2) * strain[i];
    means.add(j, u);
  }
  // Engineering strains: S is symmetric as C is, and the inverse of either is the other.
  const auto C = material::compliance({symmetric(compliance, 0, effective.asymmetry)});
  if (!C) throw RunError("the body gives way to some stress without end: no stiffness can be told");
  effective.stiffness.voigt = *C;
  effective.means = means.means();
  for (PhaseMeans& mean : effective.means) {
    mean.stress = product(mean.stress, *C);
    mean.strain = product(mean.strain, *C);
  }
}

}  // namespace

void require_loadable_cell(const model::Definition& definition, Boundary boundary) {
  const model::Places& places = definition.places;
  for (std::size_t a = 0; a < 3; ++a)
    if (boundary == Boundary::periodic && !definition.body.periodic[a])
      throw InputError(places.find("body.periodic"),
                       fmt::format("the body is not periodic in {}, but its effective stiffness is that of a body "
                                   "repeated in all directions; set periodic = [\"x\", \"y\", \"z\"] in [body], or "
                                   "take another --boundary",
                                   "xyz"[a]));
  if (!definition.boundaries.empty())
    throw InputError(places.find("boundary[0]"),
                     "the six load cases of an effective stiffness are mean strains, and nothing else holds the body; "
                     "remove the boundaries");
  if (!definition.loads.empty())
    throw InputError(places.find("load[0]"),
                     "the six load cases of an effective stiffness are mean strains; remove the loads");
  if (definition.macroscopic)
    throw InputError(places.find("macroscopic"),
                     "the six load cases of an effective stiffness are mean strains; remove [macroscopic]");
  if (definition.cuts())
    throw InputError(
        places.find("body.surface"),
        "phases and bounds of an effective stiffness are counted in whole cells, but surfaces cut cells of "
        "this body; set surface = \"stairs\"");
  if (definition.lattice.springs == material::Sharing::plain)
    throw InputError(places.find("lattice.springs"),
                     "plain springs belong to no cell, so that stress has no mean over cells of several materials; "
                     "set springs = \"shared\"");
}

namespace {

// All of it, with mixtures as phases of their own.
Effective solve_cases(const model::Model& model, const statics::StaticOptions& options, Boundary boundary) {
  assert(boundary == Boundary::periodic || model.lattice.grid.periodic == (std::array<bool, 3>{}));
  Effective effective;
  effective.boundary = boundary;
  effective.cases.resize(6);
  count_phases(model, effective);
  effective.bounds = find_bounds(model);
  effective.structure = find_structure(model);

  PhaseSums means(model, effective.phases);
  if (boundary == Boundary::periodic) {
    Matrix whole{};
    const double difference = solve_strains(model, groups_of_cases(boundary)[0], options, effective, whole, means);
    effective.stiffness.voigt = symmetric(whole, difference, effective.asymmetry);
    effective.means = means.means();
    return effective;
  }
  // The held components are those of the model, which changes from group to group.
  model::Model held = model;
  if (boundary == Boundary::traction) {
    require_whole_surface(model);
    hold_surface(boundary, {}, held);
    solve_stresses(held, options, effective, means);
    return effective;
  }
  Matrix whole{};
  double difference = 0;
  for (const std::vector<std::size_t>& cases : groups_of_cases(boundary)) {
    hold_surface(boundary, cases, held);
    difference = std::max(difference, solve_strains(held, cases, options, effective, whole, means));
  }
  // Mirror images take back what one box has of stresses of another kind than the strain.
  if (boundary == Boundary::mixed)
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t j = 0; j < 6; ++j)
        if (i != j && (i >= 3 || j >= 3)) whole[i][j] = 0;
  effective.stiffness.voigt = symmetric(whole, difference, effective.asymmetry);
  effective.means = means.means();
  return effective;
}

}  // namespace

Effective effective_stiffness(const model::Model& model, const statics::StaticOptions& options, Boundary boundary) {
  require_loadable_cell(model.definition, boundary);
  Effective effective = solve_cases(model, options, boundary);
  split_mixtures(model.definition, effective);
  return effective;
}

}  // namespace koshi::homogenize
