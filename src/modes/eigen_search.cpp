#include "modes/eigen_search.h"

#include <Eigen/Eigenvalues>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "koshi/error.h"

namespace koshi::modes {
namespace {

void append(Columns& list, Block& block, int count) {
  for (int j = 0; j < count; ++j) list.push_back(block.column(j));
}

// Columns T with T^T G T = 1 that span what G's vectors span, but for directions that rounding made.
Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& G) {
  Eigen::VectorXd scale(G.rows());
  for (Eigen::Index i = 0; i < G.rows(); ++i) scale(i) = G(i, i) > 0 ? 1 / std::sqrt(G(i, i)) : 0;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scale.asDiagonal() * G * scale.asDiagonal());
  Eigen::Index dropped = 0;
  while (dropped < G.rows() && eigen.eigenvalues()(dropped) < 1e-10) ++dropped;
  const Eigen::Index kept = G.rows() - dropped;
  return scale.asDiagonal() * eigen.eigenvectors().rightCols(kept) *
         eigen.eigenvalues().tail(kept).cwiseSqrt().cwiseInverse().asDiagonal();
}

Eigen::MatrixXd symmetric(const Eigen::MatrixXd& H) { return 0.5 * (H + H.transpose()); }

}  // namespace

EigenSearch::EigenSearch(Vibration& vibration, const Communicator& communicator, int width, const EigenSearch* earlier)
    : vibration_(vibration),
      communicator_(communicator),
      x_(vibration.size(), width),
      Ax_(vibration.size(), width),
      w_(vibration.size(), width),
      Aw_(vibration.size(), width),
      p_(vibration.size(), width),
      Ap_(vibration.size(), width),
      residual_(static_cast<std::size_t>(width)) {
  // Smooth vectors are close to low modes, but a few dozen unknowns have no room for many different smooth ones.
  const bool smooth = 20 * static_cast<std::int64_t>(width) < communicator.sum(vibration.size());
  const int known = earlier != nullptr ? earlier->width() : 0;
  for (int j = 0; j < width; ++j) {
    if (j < known)
      std::memcpy(x_.column(j), earlier->x_.column(j), static_cast<std::size_t>(x_.padded_rows()) * sizeof(double));
    else
      vibration_.start(j, smooth, x_.column(j));
  }
  // Twice: the first round makes the vectors orthonormal, the second one sees them without rounding.
  for (int round = 0; round < 2; ++round) {
    apply_all();
    best_combination(true);
  }
}

void EigenSearch::apply_all() {
  for (int j = 0; j < width(); ++j) vibration_.apply(x_.column(j), Ax_.column(j));
}

void EigenSearch::find_residuals() {
  Eigen::MatrixXd squares = Eigen::MatrixXd::Zero(width(), 1);
  for (int j = 0; j < width(); ++j) {
    const double *x = x_.column(j), *Ax = Ax_.column(j);
    double* const r = w_.column(j);
    for (std::int64_t i = 0; i < x_.padded_rows(); ++i) {
      r[i] = Ax[i] - lambda_[j] * x[i];
      squares(j, 0) += r[i] * r[i];
    }
  }
  squares = summed(squares, communicator_);
  for (int j = 0; j < width(); ++j)
    residual_[static_cast<std::size_t>(j)] = std::sqrt(squares(j, 0)) / std::abs(lambda_[j]);
}

// The residuals of the active vectors become search directions, side by side from column 0 on.
void EigenSearch::precondition_active() {
  int slot = 0;
  for (const int j : active_) {
    vibration_.precondition(w_.column(j), Aw_.column(slot));
    std::memcpy(w_.column(slot), Aw_.column(slot), static_cast<std::size_t>(vibration_.size()) * sizeof(double));
    vibration_.apply(w_.column(slot), Aw_.column(slot));
    ++slot;
  }
}

// Rayleigh and Ritz: the best vectors in the span of x, w and p; p becomes the part of them that is not x.
void EigenSearch::best_combination(bool first) {
  const int moving = first ? 0 : static_cast<int>(active_.size());
  Columns basis, image;
  append(basis, x_, width());
  append(image, Ax_, width());
  append(basis, w_, moving);
  append(image, Aw_, moving);
  append(basis, p_, first ? 0 : steps_);
  append(image, Ap_, first ? 0 : steps_);
  const Eigen::MatrixXd G = symmetric(products(basis, basis, x_.padded_rows(), communicator_));
  const Eigen::MatrixXd H = symmetric(products(basis, image, x_.padded_rows(), communicator_));
  const Eigen::MatrixXd T = orthonormal(G);
  if (T.cols() < width())
    throw RunError("the start vectors of the search for modes are not independent; ask for fewer modes");
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(symmetric(T.transpose() * H * T));
  lambda_ = eigen.eigenvalues().head(width());

  // Columns: the new vectors, then the steps that led to them, orthonormal to the vectors and to each other.
  Eigen::MatrixXd C = T * eigen.eigenvectors().leftCols(width());
  steps_ = 0;
  if (moving > 0) {
    Eigen::MatrixXd step(C.rows(), moving);
    for (int a = 0; a < moving; ++a) step.col(a) = C.col(active_[static_cast<std::size_t>(a)]);
    step.topRows(width()).setZero();
    step -= C * (C.transpose() * G * step);
    const Eigen::MatrixXd rotated = step * orthonormal(symmetric(step.transpose() * G * step));
    steps_ = static_cast<int>(rotated.cols());
    C.conservativeResize(Eigen::NoChange, width() + steps_);
    C.rightCols(steps_) = rotated;
  }
  Columns vectors, images;
  append(vectors, x_, width());
  append(vectors, p_, steps_);
  append(images, Ax_, width());
  append(images, Ap_, steps_);
  combine(basis, C, vectors, x_.padded_rows());
  combine(image, C, images, x_.padded_rows());
}

bool EigenSearch::run(const Goal& goal) {
  // Images are combined, not computed anew, at each step; their rounding is taken away now and then and at the end.
  constexpr int refresh = 15;
  bool fresh = true;
  for (int since = 0;; ++since, ++iterations_) {
    find_residuals();
    const auto first_open = std::find_if(residual_.begin(), residual_.begin() + goal.count,
                                         [&](double r) { return !(r <= goal.residual); });
    const bool done = first_open == residual_.begin() + goal.count;
    if (!fresh && (done || since % refresh == 0)) {
      apply_all();
      find_residuals();
    }
    active_.clear();
    for (int j = 0; j < width(); ++j)
      if (!(residual_[static_cast<std::size_t>(j)] <= goal.residual)) active_.push_back(j);
    const int found = static_cast<int>(
        std::count_if(residual_.begin(), residual_.begin() + goal.count, [&](double r) { return r <= goal.residual; }));
    const double worst = *std::max_element(residual_.begin(), residual_.begin() + goal.count);
    if (goal.progress && !goal.progress(iterations_, found, worst)) return false;
    if (found == goal.count) return true;
    if (since >= goal.max_iterations || !std::isfinite(worst)) give_up(goal);
    // Lengths and stiffnesses of one cell make lambda a number: a wave along a thousand cells has 1e-5.
    if (since >= 5 && lambda_[0] < 1e-13)
      throw RunError(
          "a motion of the body other than a rigid one costs no energy, so its frequency is zero; parts that hang "
          "together by single nodes or edges may turn about them: join them by whole faces, or remove them");
    precondition_active();
    best_combination(false);
    fresh = false;
  }
}

void EigenSearch::turn(int first, const Eigen::MatrixXd& rotation) {
  Columns vectors;
  for (int j = 0; j < rotation.cols(); ++j) vectors.push_back(x_.column(first + j));
  combine(vectors, rotation, vectors, x_.padded_rows());
}

void EigenSearch::give_up(const Goal& goal) const {
  std::string text;
  for (int j = 0; j < goal.count && j < 12; ++j) text += fmt::format("{}{:.1e}", j == 0 ? "" : ", ", residual(j));
  throw RunError(fmt::format(
      "the modes did not converge in {} iterations: residuals {}, wanted {:.1e}; ask for a larger analysis.tolerance "
      "(its square root is the residual) or fewer modes; parts that hang together by single nodes or by very soft "
      "material converge slowly",
      iterations_, text, goal.residual));
}

}  // namespace koshi::modes
