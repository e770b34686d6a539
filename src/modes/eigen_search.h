// The lowest eigenpairs by blocks of preconditioned residuals.
#pragma once

#include <functional>
#include <vector>

#include "modes/block.h"
#include "modes/vibration.h"

namespace koshi::modes {

/// Locally optimal block preconditioned conjugate gradients (A. Knyazev, doi:10.1137/S1064827500366124) for A y =
/// lambda y of a Vibration. The next vectors are the best ones in the space of the present ones, their preconditioned
/// residuals and the last steps, all at once; equal eigenvalues therefore come together. The steps are kept orthogonal
/// to the vectors (U. Hetmaniuk and R. Lehoucq, doi:10.1016/j.jcp.2006.02.007).
///
/// Not SLEPc's: with the BLAS that comes with Debian its orthogonalisation takes five times as long as operator and
/// multigrid together (docs/theory/13_modes.md).
class EigenSearch {
 public:
  /// `width` vectors, the first ones those of `earlier` if there is such a search (collective).
  EigenSearch(Vibration& vibration, const Communicator& communicator, int width, const EigenSearch* earlier = nullptr);

  struct Goal {
    int count = 1;             ///< pairs that must converge, at most `width`
    double residual = 1e-4;    ///< |A y - lambda y| / lambda
    int max_iterations = 300;  ///< RunError beyond
    std::function<bool(int iteration, int found, double residual)> progress;
  };
  /// False: stopped by progress (collective).
  bool run(const Goal& goal);

  int width() const { return x_.columns(); }
  int iterations() const { return iterations_; }
  double lambda(int j) const { return lambda_[j]; }
  double residual(int j) const { return residual_[static_cast<std::size_t>(j)]; }
  double* vector(int j) { return x_.column(j); }
  /// Turns `number` vectors from `first` on among themselves.
  void turn(int first, const Eigen::MatrixXd& rotation);
  std::int64_t padded_rows() const { return x_.padded_rows(); }

 private:
  void apply_all();
  void find_residuals();
  void precondition_active();
  void best_combination(bool first);
  [[noreturn]] void give_up(const Goal& goal) const;

  Vibration& vibration_;
  const Communicator& communicator_;
  Block x_, Ax_, w_, Aw_, p_, Ap_;
  Eigen::VectorXd lambda_;
  std::vector<double> residual_;
  std::vector<int> active_;  ///< vectors that still move
  int steps_ = 0;            ///< columns of p_ in use
  int iterations_ = 0;
};

}  // namespace koshi::modes
