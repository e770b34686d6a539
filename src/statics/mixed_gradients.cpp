#include "statics/mixed_gradients.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/exact_sum.h"
#include "base/lane_sum.h"
#include "base/out_of_memory.h"
#include "base/progress.h"
#include "mechanics/uniform_strain.h"
#include "statics/ending.h"

namespace koshi::statics {
namespace {

// Ratio of stiffness up to which single precision leaves a thousandth of the residual right.
constexpr double most_contrast = 1e4;

// Fall of the residual after which it is taken anew: what single precision has left of its seven digits is then as
// good as the steps that made it.
constexpr double fall = 1e-3;

// Energy that conjugate gradients have yet to release, from what the last three steps have: a geometric series
// (Hestenes and Stiefel 1952: the error's energy is the sum of all that is to come).
double to_come(const std::vector<double>& released) {
  const std::size_t n = released.size();
  if (n < 3) return std::numeric_limits<double>::infinity();
  const double ratio = std::sqrt(released[n - 1] / released[n - 3]);
  return ratio < 1 ? released[n - 1] * ratio / (1 - ratio) : std::numeric_limits<double>::infinity();
}

// Sum of products along a row.
double row_product(const float* a, const float* b, std::int64_t count) {
  return lane_sum<16>(count, [&](std::int64_t i) { return static_cast<double>(a[i]) * static_cast<double>(b[i]); });
}

}  // namespace

bool MixedGradients::serves(const model::Model& model, const StaticOptions& options) {
  const model::SpringLattice& body = model.lattice;
  for (std::size_t m = 1; m < body.springs.size(); ++m)
    if (body.components() == 6 && body.springs[m].kt[1] == 0 && body.springs[m].kt[2] == 0) return false;
  const bool plain = body.sharing == material::Sharing::plain || !body.surface.empty() || !body.ground.empty();
  return options.petsc_options.empty() && !model.communicator.any(plain) && contrast(model) <= most_contrast;
}

MixedGradients::MixedGradients(const model::Model& model, const StaticOptions& options)
    : model_(model),
      options_(options),
      start_(steady_seconds()),
      session_(model.communicator, options.petsc_options),
      kernel_(model.lattice) {
  const FixedNodes held = fixed_nodes(model);
  free_ = std::make_unique<FreeMotions>(model, held);
  while_making("the levels of the solver", [&] {
    preconditioner_ = std::make_unique<Preconditioner>(model, held, *free_);
    direction_ = RowField<float>(model.layout().owned(), model.components());
  });
  unit_ = preconditioner_->unit() * model.lattice.grid.d;
  setup_seconds_ = steady_seconds() - start_;
}

template <class F>
void MixedGradients::for_each_row(F&& use) const {
  const Int3& n = model_.layout().owned();
  for (std::int64_t k = 0; k < n[2]; ++k)
    for (std::int64_t j = 0; j < n[1]; ++j) use(j, k);
}

double MixedGradients::product(const RowField<float>& a, const RowField<float>& b) const {
  ExactSum sum;
  for_each_row([&](std::int64_t j, std::int64_t k) {
    for (int c = 0; c < a.components(); ++c)
      sum += row_product(a.row(j, k) + c * a.pitch(), b.row(j, k) + c * b.pitch(), a.owned()[0]);
  });
  sum.sum_ranks(model_.communicator);
  return sum.value();
}

double MixedGradients::take_residual(const lattice::Field<double>& u) {
  Level& level = preconditioner_->finest();
  const double half_d = 0.5 * model_.lattice.grid.d;
  kernel_.for_each_row(u, [&](std::int64_t j, std::int64_t k, double* const* force) {
    for (int c = 0; c < model_.components(); ++c) {
      const double factor = 1 / (c < 3 ? unit_ : unit_ * half_d);
      float* const to = level.b.row(j, k) + c * level.b.pitch();
      for (std::int64_t i = 0; i < level.b.owned()[0]; ++i) to[i] = static_cast<float>(factor * force[c][i]);
    }
  });
  clear_fixed(level.fixed(), level.b);
  return unit_ * std::sqrt(product(level.b, level.b));
}

void MixedGradients::turn(float beta) {
  const RowField<float>& z = preconditioner_->finest().x;
  for_each_row([&](std::int64_t j, std::int64_t k) {
    for (int c = 0; c < z.components(); ++c) {
      const float* const from = z.row(j, k) + c * z.pitch();
      float* const to = direction_.row(j, k) + c * direction_.pitch();
      for (std::int64_t i = 0; i < z.owned()[0]; ++i) to[i] = from[i] + beta * to[i];
    }
  });
}

double MixedGradients::advance(double alpha, lattice::Field<double>& u) {
  Level& level = preconditioner_->finest();
  const lattice::Layout& layout = model_.layout();
  // Lengths of the level are spacings, its rotations rho = (d/2) w.
  const double length = alpha * model_.lattice.grid.d, angle = 2 * alpha;
  const auto step = static_cast<float>(alpha);
  ExactSum square;
  for_each_row([&](std::int64_t j, std::int64_t k) {
    for (int c = 0; c < model_.components(); ++c) {
      const std::int64_t count = layout.owned()[0];
      const double factor = c < 3 ? length : angle;
      const float* const direction = direction_.row(j, k) + c * direction_.pitch();
      double* const moved = u.component(c) + layout.index(0, j, k);
      for (std::int64_t i = 0; i < count; ++i) moved[i] += factor * static_cast<double>(direction[i]);
      const float* const image = level.image().row(j, k) + c * level.image().pitch();
      float* const residual = level.b.row(j, k) + c * level.b.pitch();
      for (std::int64_t i = 0; i < count; ++i) residual[i] -= step * image[i];
      square += row_product(residual, residual, count);
    }
  });
  square.sum_ranks(model_.communicator);
  return unit_ * std::sqrt(square.value());
}

ByteField MixedGradients::kept(const mechanics::Tensor6& mean_strain, const lattice::Field<double>& u) const {
  const lattice::Layout& layout = model_.layout();
  const double d = model_.lattice.grid.d;
  // In the units of the level: lengths of spacings, rotations rho = (d/2) w.
  return ByteField(layout.owned(), model_.components(), [&](int c, std::int64_t i, std::int64_t j, std::int64_t k) {
    const double value = u.component(c)[layout.index(i, j, k)];
    if (c >= 3) return value / 2;
    const Vec3 affine = mechanics::uniform_displacement(model_, mean_strain, layout.global({i, j, k}));
    return (value - affine[static_cast<std::size_t>(c)]) / d;
  });
}

double MixedGradients::work(const ByteField& kept) const {
  return unit_ * model_.lattice.grid.d * kept.product(preconditioner_->finest().b, model_.communicator);
}

SolveReport MixedGradients::solve(const mechanics::Tensor6& mean_strain, double absolute, lattice::Field<double>& u) {
  SolveReport report;
  const double start = steady_seconds();
  report.projected_motions = free_->count();
  report.free_motions = free_->description();
  report.levels = preconditioner_->level_count();
  report.unknowns = model_.node_count * model_.components() - model_.motion_count;
  report.setup_seconds = setup_seconds_;
  report.unused_options = session_.unused_options();

  u.zero();
  mechanics::add_uniform_strain(model_, mean_strain, u);
  Level& level = preconditioner_->finest();
  direction_.zero();
  double norm = take_residual(u), taken = norm, rz = 0;
  const double reference = norm;
  // Energies in units of the level.
  std::vector<double> released;
  double all_released = 0;
  const auto is_released = [&] { return to_come(released) <= options_.tolerance * all_released; };
  KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
  while (true) {
    report.relative_residual = reference > 0 ? norm / reference : 0;
    report.residual_history.push_back(report.relative_residual);
    if (options_.progress) options_.progress(report.iterations, report.relative_residual);
    if (norm <= absolute)
      reason = KSP_CONVERGED_ATOL;
    else if (is_released())
      reason = KSP_CONVERGED_RTOL;
    if (!std::isfinite(norm)) reason = KSP_DIVERGED_NANORINF;
    report.stopped = options_.stop && options_.stop();
    if (reason != KSP_CONVERGED_ITERATING || report.stopped) break;
    if (report.iterations == options_.max_iterations) {
      reason = KSP_DIVERGED_ITS;
      break;
    }

    preconditioner_->cycle();
    const double before = rz;
    rz = product(level.b, level.x);
    if (rz < 0) reason = KSP_DIVERGED_INDEFINITE_PC;
    turn(report.iterations == 0 ? 0 : static_cast<float>(rz / before));
    level.make_image(direction_);
    const double work = product(direction_, level.image());
    if (work < 0) reason = KSP_DIVERGED_INDEFINITE_MAT;
    if (reason != KSP_CONVERGED_ITERATING) break;
    norm = advance(rz / work, u);
    released.push_back(rz * rz / work);
    all_released += released.back();
    if (norm <= absolute || is_released() || norm <= fall * taken) {
      mechanics::exchange_displacements(model_, mean_strain, u);
      norm = taken = take_residual(u);
    }
    ++report.iterations;
  }
  report.solve_seconds = steady_seconds() - start;
  report.converged = reason > 0 && !report.stopped;
  report.reason = report.stopped ? "stopped" : end_in_words(reason);
  if (!report.converged && !report.stopped) throw no_equilibrium(model_, report, reason);
  return report;
}

}  // namespace koshi::statics
