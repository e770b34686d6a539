#include "mechanics/dispersion.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include <Eigen/Eigenvalues>

#include "mechanics/cell_matrix.h"

namespace koshi::mechanics {
namespace {

using Modes = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd>;

/// An omega^2 below this part of the largest one is rounding about zero.
constexpr double zero = 1e-11;

}  // namespace

NodeInertia node_inertia(double density, double d) {
  const double mass = density * d * d * d;
  const double R = d * std::cbrt(3 / (4 * std::numbers::pi));
  return {mass, 0.4 * mass * R * R};
}

PeriodicLattice::PeriodicLattice(const material::Springs& springs, double d, material::Kinematics kinematics,
                                 double density)
    : d_(d), cell_(cell_matrix(springs, d, kinematics)), inverse_root_(components(kinematics)) {
  const NodeInertia inertia = node_inertia(density, d);
  for (int c = 0; c < components(kinematics); ++c) inverse_root_(c) = 1 / std::sqrt(c < 3 ? inertia.mass : inertia.J);
}

Eigen::MatrixXcd PeriodicLattice::dynamic_matrix(const Vec3& phase) const {
  // A node is corner a of one of its eight cells each; corner b of that cell moves with the phase of its distance.
  const Eigen::Index n = inverse_root_.size();
  Eigen::MatrixXcd D = Eigen::MatrixXcd::Zero(n, n);
  for (int a = 0; a < corner_count; ++a)
    for (int b = 0; b < corner_count; ++b) {
      double angle = 0;
      for (int axis = 0; axis < 3; ++axis) angle += phase[axis] * (corner(b)[axis] - corner(a)[axis]);
      D += std::polar(1.0, angle) * cell_.block(a * n, b * n, n, n);
    }
  const Eigen::MatrixXcd scaled = inverse_root_.asDiagonal() * D * inverse_root_.asDiagonal();
  return 0.5 * (scaled + scaled.adjoint());
}

PhaseSpeeds phase_speeds(const PeriodicLattice& lattice, const Vec3& direction, double cells) {
  const Vec3 normal = (1 / norm(direction)) * direction;
  const double phase = 2 * std::numbers::pi / cells;
  const Modes modes(lattice.dynamic_matrix(phase * normal));

  // Part of each mode's kinetic energy that goes along and across the wave vector.
  const Eigen::Index n = modes.eigenvalues().size();
  const Eigen::Vector3d k(normal[0], normal[1], normal[2]);
  Eigen::VectorXd along(n), across(n);
  for (Eigen::Index mode = 0; mode < n; ++mode) {
    const Eigen::Vector3cd u = modes.eigenvectors().col(mode).head<3>();
    const std::complex<double> longitudinal = k.cast<std::complex<double>>().dot(u);
    along(mode) = std::norm(longitudinal);
    across(mode) = u.squaredNorm() - along(mode);
  }
  const auto speed = [&](Eigen::Index mode) {
    return std::sqrt(std::max(0.0, modes.eigenvalues()(mode))) * lattice.spacing() / phase;
  };

  PhaseSpeeds speeds;
  Eigen::Index p = 0, s1 = 0, s2 = 0;
  along.maxCoeff(&p);
  speeds.p = speed(p);
  across(p) = -1;
  across.maxCoeff(&s1);
  across(s1) = -1;
  across.maxCoeff(&s2);
  speeds.s_slow = std::min(speed(s1), speed(s2));
  speeds.s_fast = std::max(speed(s1), speed(s2));
  return speeds;
}

std::vector<DispersionRow> dispersion_table(const PeriodicLattice& lattice) {
  std::vector<DispersionRow> table;
  for (const Vec3& direction : {Vec3{1, 0, 0}, Vec3{1, 1, 0}, Vec3{1, 1, 1}})
    for (const double cells : {40, 20, 10, 8, 6, 4})
      table.push_back({direction, cells, phase_speeds(lattice, direction, cells)});
  return table;
}

ZoneScan scan_zone(const PeriodicLattice& lattice, int divisions) {
  struct Sample {
    Vec3 phase;
    Modes modes;
  };
  std::vector<Sample> samples;
  ZoneScan scan;
  scan.least = std::numeric_limits<double>::infinity();
  for (int i = 1; i <= divisions; ++i)
    for (int j = 0; j <= i; ++j)
      for (int k = 0; k <= j; ++k) {
        const double step = std::numbers::pi / divisions;
        samples.push_back(
            {{step * i, step * j, step * k}, Modes(lattice.dynamic_matrix({step * i, step * j, step * k}))});
        const Eigen::VectorXd& squares = samples.back().modes.eigenvalues();
        scan.largest = std::max(scan.largest, squares.maxCoeff());
        if (squares.minCoeff() < scan.least) {
          scan.least = squares.minCoeff();
          scan.least_phase = samples.back().phase;
        }
      }
  scan.vectors = static_cast<int>(samples.size());

  // Soft modes can only be told from rounding once the largest omega^2 is known.
  for (const Sample& sample : samples) {
    const Eigen::VectorXd& squares = sample.modes.eigenvalues();
    bool soft = false;
    for (Eigen::Index mode = 0; mode < squares.size() && squares(mode) < zero * scan.largest; ++mode) {
      soft = true;
      if (sample.modes.eigenvectors().col(mode).head<3>().norm() > 1e-6) scan.soft_moves = true;
    }
    scan.soft_vectors += soft;
  }
  if (std::abs(scan.least) < zero * scan.largest) scan.least = 0;
  return scan;
}

}  // namespace koshi::mechanics
