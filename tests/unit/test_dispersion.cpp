// Plane waves of the infinite lattice against closed forms and the continuum.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <complex>
#include <numbers>

#include "koshi/calibration.h"
#include "mechanics/bond_law.h"
#include "mechanics/dispersion.h"
#include "support/reference_cells.h"

namespace koshi::mechanics {
namespace {

using material::Kinematics;
using std::numbers::pi;

constexpr double d = 0.002;

material::Elastic rock(double nu) { return {1112e6, nu, 2000}; }

// A P wave along [100] moves planes of nodes against each other and turns none: a chain of masses rho d^3 and springs
// C1111 d, so omega = 2 sqrt(C1111 d/m) sin(kd/2) and c/c_p = sin(kd/2)/(kd/2), whatever the springs.
TEST(Dispersion, CompressionAlongAnAxisIsAChain) {
  int checked = 0;
  for (const auto& reference : test::reference_cells()) {
    const material::Elastic elastic = rock(reference.elastic.poissons_ratio);
    const auto springs = springs_for(reference.cell, reference.calibration, reference.kinematics, elastic, d);
    const PeriodicLattice lattice(springs, d, reference.kinematics, elastic.density);
    for (const double cells : {40.0, 7.5, 4.0, 3.0}) {
      const double half = pi / cells;
      const double expected = elastic.p_wave_speed() * std::sin(half) / half;
      EXPECT_NEAR(phase_speeds(lattice, {0, 1, 0}, cells).p / expected, 1, 1e-10) << reference.name;
      ++checked;
    }
  }
  EXPECT_EQ(checked, 39 * 4);
}

// An S wave along x in Cube-I with node rotations: unknowns u_y = u e^{ikx}, w_z = i w e^{ikx}. With h = kd/2 the bonds
// along x see |r| = 2 sin(h) u - d cos(h) w, those along y |r| = d w:
//   kt [[4 sin^2 h, -2 d sin h cos h], [-2 d sin h cos h, d^2 (1 + cos^2 h)]] - omega^2 diag(m, J) is singular.
TEST(Dispersion, ShearAlongAnAxisOfCubeI) {
  const material::Elastic elastic = rock(0.2);
  const auto springs = material::isotropic_springs(lattice::CellType::cube_i, elastic, d);
  const PeriodicLattice lattice(springs, d, Kinematics::rotational, elastic.density);
  const double kt = springs.kt[0], m = 2000 * d * d * d;
  const double J = 0.4 * m * d * d * std::pow(3 / (4 * pi), 2.0 / 3);
  for (const double cells : {30.0, 8.0, 5.0}) {
    const double h = pi / cells, s = std::sin(h), c = std::cos(h);
    const double a = kt * 4 * s * s / m, b = kt * d * d * (1 + c * c) / J,
                 off = 4 * kt * kt * d * d * s * s * c * c / (m * J);
    const double omega2 = (a + b) / 2 - std::sqrt((a - b) * (a - b) / 4 + off);
    const PhaseSpeeds speeds = phase_speeds(lattice, {1, 0, 0}, cells);
    const double expected = std::sqrt(omega2) / (2 * h / d);
    EXPECT_NEAR(speeds.s_slow / expected, 1, 1e-10);
    EXPECT_NEAR(speeds.s_fast / expected, 1, 1e-10);
  }
}

// The dynamic matrix gives the forces and moments the bond law puts on a node in a wave u_n + i w_n = q e^{i phase.n}:
// the 26 bonds of one node, summed one by one for the real and imaginary parts (no volumetric spring at nu = 0.18).
TEST(Dispersion, DynamicMatrixAgreesWithTheBondSum) {
  const material::Elastic elastic = rock(0.18);
  const auto springs = material::isotropic_springs(lattice::CellType::cube_iii, elastic, d);
  ASSERT_EQ(springs.kappa, 0);
  const PeriodicLattice lattice(springs, d, Kinematics::rotational, elastic.density);
  const Vec3 phase{0.4, -1.1, 2.0};
  const NodeInertia inertia = node_inertia(elastic.density, d);
  Eigen::VectorXcd q(6);
  q << std::complex(0.3, 0.1), std::complex(-0.2, 0.5), 0.7, std::complex(1.0, -0.4), 0.6, std::complex(-0.8, 0.9);
  q.tail<3>() *= 1 / d;  // rotations as large as displacements over a spacing

  Eigen::VectorXcd force = Eigen::VectorXcd::Zero(6);
  int bonds = 0;
  for (const std::complex<double> part : {std::complex(1.0, 0.0), std::complex(0.0, 1.0)}) {
    const auto unknown = [&](const std::array<int, 3>& n, int component) {
      const std::complex<double> u =
          q(component) * std::polar(1.0, phase[0] * n[0] + phase[1] * n[1] + phase[2] * n[2]);
      return part.real() == 1 ? u.real() : u.imag();
    };
    const auto vector = [&](const std::array<int, 3>& n, int first) {
      return Vec3{unknown(n, first), unknown(n, first + 1), unknown(n, first + 2)};
    };
    for (const lattice::Slot& slot : lattice::slots)
      for (const int sign : {1, -1}) {
        // The node is node 1 of its forward bonds and node 2 of its backward ones.
        const std::array<int, 3> here{}, there{sign * slot.s[0], sign * slot.s[1], sign * slot.s[2]};
        const auto& node1 = sign > 0 ? here : there;
        const auto& node2 = sign > 0 ? there : here;
        const Vec3 D{-d * slot.s[0], -d * slot.s[1], -d * slot.s[2]};
        const Vec3 w = 0.5 * (vector(node1, 3) + vector(node2, 3));
        const Vec3 r = relative_displacement(vector(node1, 0), vector(node2, 0), w, D);
        const Vec3 F = bond_force(springs.kn[slot.family], springs.kt[slot.family], D, r), M = bond_moment(D, F);
        for (int c = 0; c < 3; ++c) {
          force(c) -= part * (sign * F[c]);
          force(3 + c) += part * M[c];
        }
        ++bonds;
      }
  }
  EXPECT_EQ(bonds, 2 * 26);

  Eigen::VectorXd root(6);
  root << Eigen::Vector3d::Constant(std::sqrt(inertia.mass)), Eigen::Vector3d::Constant(std::sqrt(inertia.J));
  const Eigen::VectorXcd found = -(root.asDiagonal() * lattice.dynamic_matrix(phase) * root.asDiagonal() * q);
  for (int c = 0; c < 6; ++c) {
    EXPECT_NEAR(found(c).real(), force(c).real(), 1e-12 * force.head<3>().norm()) << c;
    EXPECT_NEAR(found(c).imag(), force(c).imag(), 1e-12 * force.head<3>().norm()) << c;
  }
  EXPECT_GT(force.tail<3>().norm(), 1e-6 * force.head<3>().norm());
}

// Long waves travel at the continuum's speeds along any direction, with an error of second order in kd: 20 cells per
// wavelength leave four times the error of 40. Largest errors at nu = 0.18: P along [111].
TEST(Dispersion, ContinuumSpeedsToSecondOrder) {
  const material::Elastic elastic = rock(0.18);
  int checked = 0;
  for (const auto& reference : test::reference_cells()) {
    if (reference.elastic.poissons_ratio != 0.18) continue;
    const auto springs = springs_for(reference.cell, reference.calibration, reference.kinematics, elastic, d);
    const PeriodicLattice lattice(springs, d, reference.kinematics, elastic.density);
    const auto table = dispersion_table(lattice);
    ASSERT_EQ(table.size(), 18u);
    const auto errors = [&](const PhaseSpeeds& c) {
      return std::array{c.p / elastic.p_wave_speed() - 1, c.s_slow / elastic.s_wave_speed() - 1,
                        c.s_fast / elastic.s_wave_speed() - 1};
    };
    for (std::size_t row = 0; row < table.size(); row += 6) {
      ASSERT_EQ(table[row].cells, 40);
      ASSERT_EQ(table[row + 1].cells, 20);
      const auto at40 = errors(table[row].speeds), at20 = errors(table[row + 1].speeds);
      for (int wave = 0; wave < 3; ++wave, ++checked) {
        EXPECT_LT(std::abs(at20[wave]), 0.0086) << reference.name;
        EXPECT_LT(std::abs(at40[wave]), 0.0022) << reference.name;
        EXPECT_NEAR(at20[wave] / at40[wave], 4, 0.1) << reference.name << " row " << row << " wave " << wave;
      }
    }
    const PhaseSpeeds axis20 = table[1].speeds, axis40 = table[0].speeds;
    for (const double error : errors(axis20)) EXPECT_LT(std::abs(error), 0.005) << reference.name;
    for (const double error : errors(axis40)) EXPECT_LT(std::abs(error), 0.0013) << reference.name;
  }
  EXPECT_EQ(checked, 8 * 9);
}

// Chapter 11: c / c_0 = 1 - A (k d)^2 with A = G / (2 M), G linear in the springs by table (11.3), plus J / (8 m d^2)
// for S waves that turn nodes. From the errors at 20 and 40 cells per wavelength the next order drops out.
struct LongWave {
  Vec3 direction, polarisation;
  std::array<double, 3> kn, rotational, fitted;  ///< weights of kn and of kt by family
  double kappa;
};
const std::array<LongWave, 7> long_waves{{
    {{1, 0, 0}, {1, 0, 0}, {1. / 12, 1. / 6, 1. / 9}, {0, 1. / 6, 2. / 9}, {0, 1. / 6, 2. / 9}, 1. / 12},
    {{1, 1, 0}, {1, 1, 0}, {1. / 48, 17. / 48, 4. / 9}, {1. / 48, 1. / 16, 2. / 9}, {1. / 48, 1. / 16, 2. / 9}, 1. / 6},
    {{1, 1, 1},
     {1, 1, 1},
     {1. / 108, 8. / 27, 61. / 81},
     {1. / 54, 4. / 27, 2. / 81},
     {1. / 54, 4. / 27, 2. / 81},
     7. / 36},
    {{1, 0, 0}, {0, 1, 0}, {0, 1. / 12, 1. / 9}, {-1. / 48, -1. / 24, 1. / 18}, {1. / 24, 1. / 12, 1. / 18}, 0},
    {{1, 1, 0}, {0, 0, 1}, {0, 1. / 24, 2. / 9}, {-1. / 96, -1. / 48, -5. / 36}, {-1. / 24, 1. / 24, 1. / 9}, 0},
    {{1, 1, 0}, {1, -1, 0}, {1. / 48, 1. / 48, 0}, {0, -1. / 16, -1. / 6}, {-1. / 16, 1. / 16, 1. / 3}, 0},
    {{1, 1, 1},
     {1, -1, 0},
     {1. / 108, 2. / 27, 1. / 81},
     {1. / 216, -11. / 108, -10. / 81},
     {-17. / 216, -1. / 54, 61. / 162},
     0},
}};

/// Squared frequency of the wave that moves along `polarisation`: these directions are axes of symmetry, so such a wave
/// exists, alone or among waves of one frequency.
double squared_frequency(const PeriodicLattice& lattice, const LongWave& wave, double kd) {
  const Vec3 normal = (kd / norm(wave.direction)) * wave.direction;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd> modes(lattice.dynamic_matrix(normal));
  Eigen::Index best = 0;
  double most = 0;
  for (Eigen::Index mode = 0; mode < modes.eigenvalues().size(); ++mode) {
    std::complex<double> along = 0;
    for (int c = 0; c < 3; ++c) along += wave.polarisation[c] * modes.eigenvectors()(c, mode);
    if (std::abs(along) > most) {
      most = std::abs(along);
      best = mode;
    }
  }
  return modes.eigenvalues()(best);
}

TEST(Dispersion, LongWavesFollowTheClosedForms) {
  constexpr double turning = 0.4 * 0.3848347 / 8;  // J / (8 m d^2), R^2 = (3 / 4 pi)^(2/3) d^2
  int checked = 0;
  double largest = 0;
  for (const auto& reference : test::reference_cells()) {
    const material::Elastic elastic = rock(reference.elastic.poissons_ratio);
    const bool rotational = reference.kinematics == Kinematics::rotational;
    const auto springs = springs_for(reference.cell, reference.calibration, reference.kinematics, elastic, d);
    const PeriodicLattice lattice(springs, d, reference.kinematics, elastic.density);
    for (const LongWave& wave : long_waves) {
      const bool p = wave.direction == wave.polarisation;
      double G = wave.kappa * springs.kappa;
      for (int family = 0; family < 3; ++family)
        G += (wave.kn[family] * springs.kn[family] +
              (rotational ? wave.rotational : wave.fitted)[family] * springs.kt[family]) /
             d;
      const double M = p ? elastic.lambda() + 2 * elastic.mu() : elastic.mu();
      const double A = G / (2 * M) + (!p && rotational ? turning : 0);

      const double c0 = p ? elastic.p_wave_speed() : elastic.s_wave_speed();
      const auto found = [&](double cells) {
        const double kd = 2 * pi / cells;
        return (1 - std::sqrt(squared_frequency(lattice, wave, kd)) * d / (kd * c0)) / (kd * kd);
      };
      EXPECT_NEAR((4 * found(40) - found(20)) / 3, A, 1e-5) << reference.name;
      largest = std::max(largest, std::abs(A));
      ++checked;
    }
  }
  EXPECT_EQ(checked, 39 * 7);
  EXPECT_GT(largest, 0.09);  // P along [111] near nu = 1/2: 7/72
}

// The free constant t of (8.5) moves no wave: bending, coupling and torsion fix them. P along [111] at nu = 0.18:
// A = (15 - 22 nu + 5 nu^2) / (216 (1 - nu)^2).
TEST(Dispersion, WavesOfBendingExactSpringsAreFixed) {
  const double nu = 0.18, c = 2 * nu / (3 * (1 - nu)), t0 = 2.0 / 9 * (1 - 3 * nu) / (1 - nu);
  const material::Elastic elastic = rock(nu);
  int checked = 0;
  for (const double t : {0.4 * t0, t0, 1.2 * t0}) {
    const double scale = elastic.mu() * d;
    material::Springs springs = material::bending_exact_springs(elastic, d, Kinematics::rotational);
    const double step = t - t0;
    const std::array<double, 3> change{-2, 1, -0.5};
    for (int family = 0; family < 3; ++family) {
      springs.kn[family] += change[family] * step * scale;
      springs.kt[family] += change[family] * step * scale;
    }
    EXPECT_NEAR(springs.kn[1] / scale, t + c, 1e-12);
    const PeriodicLattice lattice(springs, d, Kinematics::rotational, elastic.density);
    const auto error = [&](double cells) {
      return 1 - phase_speeds(lattice, {1, 1, 1}, cells).p / elastic.p_wave_speed();
    };
    const double kd2 = 4 * pi * pi / 1600;
    EXPECT_NEAR(error(40) / kd2, (15 - 22 * nu + 5 * nu * nu) / (216 * (1 - nu) * (1 - nu)), 2e-4);
    EXPECT_NEAR(error(20), 0.00758, 1e-5);
    ++checked;
  }
  EXPECT_EQ(checked, 3);
}

// What the guide promises for waves: with the automatic step, 0.9 of the lesser of d / c_p and 2 / omega_max, isotropic
// Cube-II and -III keep every wave within 0.5 % at 20 cells per wavelength and 0.13 % at 40, for -0.5 <= nu <= 0.4;
// bending-exact springs within 0.62 and 0.16 %, and not within 0.5 %. Steps turn omega into 2/dt asin(omega dt/2).
TEST(Dispersion, SpeedsAtTheAutomaticStep) {
  const auto worst = [](const material::Springs& springs, const material::Elastic& elastic, Kinematics kinematics,
                        double cells) {
    const PeriodicLattice lattice(springs, d, kinematics, elastic.density);
    const double dt = 0.9 * std::min(d / elastic.p_wave_speed(), 2 / std::sqrt(scan_zone(lattice).largest));
    const double k = 2 * pi / (cells * d);
    double worst = 0;
    for (const Vec3& direction : {Vec3{1, 0, 0}, Vec3{1, 1, 0}, Vec3{1, 1, 1}}) {
      const PhaseSpeeds c = phase_speeds(lattice, direction, cells);
      for (const auto& [speed, solid] :
           {std::pair(c.p, elastic.p_wave_speed()), std::pair(c.s_slow, elastic.s_wave_speed()),
            std::pair(c.s_fast, elastic.s_wave_speed())})
        worst = std::max(worst, std::abs(2 / dt * std::asin(speed * k * dt / 2) / k / solid - 1));
    }
    return worst;
  };
  int checked = 0;
  for (const double nu : {-0.5, -0.3, 0.0, 0.1, 0.18, 0.25, 0.3, 0.35, 0.4})
    for (const Kinematics kinematics : {Kinematics::rotational, Kinematics::least_squares}) {
      for (const auto cell : {lattice::CellType::cube_ii, lattice::CellType::cube_iii}) {
        const auto springs = material::isotropic_springs(cell, rock(nu), d);
        EXPECT_LT(worst(springs, rock(nu), kinematics, 20), 0.0050) << nu;
        EXPECT_LT(worst(springs, rock(nu), kinematics, 40), 0.0013) << nu;
        ++checked;
      }
      if (nu < 0) continue;
      const auto exact = material::bending_exact_springs(rock(nu), d, kinematics);
      EXPECT_LT(worst(exact, rock(nu), kinematics, 20), 0.0062) << nu;
      EXPECT_GT(worst(exact, rock(nu), kinematics, 20), 0.0049) << nu;
      EXPECT_LT(worst(exact, rock(nu), kinematics, 40), 0.0016) << nu;
    }
  EXPECT_EQ(checked, 36);
}

// The highest squared frequency of the least-squares lattice at large nu: 4 C1111 d/m = 4 c_p^2/d^2 at kd = (pi, 0, 0).
TEST(Dispersion, ZoneScan) {
  const material::Elastic elastic = rock(0.45);
  const auto springs = material::isotropic_springs(lattice::CellType::cube_i, elastic, d);
  const ZoneScan scan = scan_zone(PeriodicLattice(springs, d, Kinematics::least_squares, elastic.density));
  const double c_p = elastic.p_wave_speed();
  EXPECT_NEAR(scan.largest / (4 * c_p * c_p / (d * d)), 1, 1e-10);
  EXPECT_GT(scan.least, 0);
  EXPECT_EQ(scan.vectors, 454);  // multisets of size 3 from 13 numbers, 455, less the zero vector
  EXPECT_EQ(scan.soft_vectors, 0);
}

}  // namespace
}  // namespace koshi::mechanics
