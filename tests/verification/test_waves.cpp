// Plane waves in bars and periodic boxes: frequencies in time against the lattice's own dispersion and the continuum's.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <complex>
#include <numbers>

#include "driver/simulation.h"
#include "koshi/calibration.h"
#include "koshi/dynamics.h"
#include "mechanics/dispersion.h"
#include "support/cases.h"

namespace koshi {
namespace {

using lattice::CellType;
using material::Kinematics;
constexpr double pi = std::numbers::pi;

const material::Elastic rock{1112e6, 0.3, 2000};
constexpr double d = 0.002;

struct Lattice {
  const char* name;
  CellType cell;
  material::Calibration calibration;
  Kinematics kinematics;
};

class Waves : public testing::TestWithParam<Lattice> {
 protected:
  mechanics::PeriodicLattice periodic() const {
    const Lattice& p = GetParam();
    return {material::springs_for(p.cell, p.calibration, p.kinematics, rock, d), d, p.kinematics, rock.density};
  }

  model::Definition definition(const Int3& cells) const {
    const Lattice& p = GetParam();
    model::Definition definition = test::block(cells, d, rock);
    definition.lattice.cell = p.cell;
    definition.lattice.calibration = p.calibration;
    definition.lattice.kinematics = p.kinematics;
    return definition;
  }
};

struct Wave {
  double omega = 0;            ///< of the lattice, time continuous [1/s]
  Eigen::VectorXcd amplitude;  ///< of u_n = amplitude exp(i k.x_n)
};

// The wave whose nodes move most along `polarisation`. Modes of one frequency may be mixed at will: theirs is the mix
// that moves along it.
Wave wave_of(const mechanics::PeriodicLattice& lattice, const mechanics::NodeInertia& inertia, const Vec3& phase,
             const Vec3& polarisation) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd> solver(lattice.dynamic_matrix(phase));
  const Eigen::VectorXd& squares = solver.eigenvalues();
  Wave best;
  double most = 0;
  for (Eigen::Index m = 0; m < squares.size(); ++m) {
    Eigen::VectorXcd mix = Eigen::VectorXcd::Zero(squares.size());
    double along = 0;
    for (Eigen::Index other = 0; other < squares.size(); ++other) {
      if (std::abs(squares(other) - squares(m)) > 1e-9 * squares(m)) continue;
      std::complex<double> part = 0;
      for (int c = 0; c < 3; ++c) part += polarisation[static_cast<std::size_t>(c)] * solver.eigenvectors()(c, other);
      along += std::norm(part);
      mix += std::conj(part) * solver.eigenvectors().col(other);
    }
    if (along <= most) continue;
    most = along;
    for (Eigen::Index c = 0; c < mix.size(); ++c) mix(c) /= std::sqrt(c < 3 ? inertia.mass : inertia.J);
    best = {std::sqrt(squares(m)), mix / mix.head(3).norm()};
  }
  return best;
}

// Starts the standing wave Re(amplitude exp(i k.x)) and reads its frequency from the recursion of its amplitude a(n),
// a(n+1) + a(n-1) = 2 cos(omega' dt) a(n), by least squares. `shape_error`: what is not this wave after all steps.
double frequency_in_time(const model::Definition& definition, const Vec3& phase, const Wave& wave, double dt, int steps,
                         double& shape_error) {
  const model::Model model = model::make_model(definition, Communicator::world());
  model::State state(model);
  const auto shape = [&](int c, std::int64_t i, std::int64_t j, std::int64_t k) {
    const double at =
        phase[0] * static_cast<double>(i) + phase[1] * static_cast<double>(j) + phase[2] * static_cast<double>(k);
    return (wave.amplitude(c) * std::polar(1.0, at)).real();
  };
  double norm = 0;
  lattice::for_each_owned(model.layout(), [&](auto i, auto j, auto k, auto n) {
    for (int c = 0; c < model.components(); ++c) {
      state.displacement.component(c)[n] = shape(c, i, j, k);
      // At rest at time 0: v(-dt/2) = (u(0) - u(-1)) / dt with u(-1) = u(1) = u(0) (1 - omega^2 dt^2 / 2).
      state.velocity.component(c)[n] = 0.5 * wave.omega * wave.omega * dt * shape(c, i, j, k);
      if (c < 3) norm += shape(c, i, j, k) * shape(c, i, j, k);
    }
  });
  dynamics::ExplicitSolver solver(model, state, dt);
  std::vector<double> a{1};
  for (int step = 0; step < steps; ++step) {
    solver.step();
    double projection = 0;
    lattice::for_each_owned(model.layout(), [&](auto i, auto j, auto k, auto n) {
      for (int c = 0; c < 3; ++c) projection += state.displacement.component(c)[n] * shape(c, i, j, k);
    });
    a.push_back(projection / norm);
  }
  shape_error = 0;
  lattice::for_each_owned(model.layout(), [&](auto i, auto j, auto k, auto n) {
    for (int c = 0; c < 3; ++c)
      shape_error = std::max(shape_error, std::abs(state.displacement.component(c)[n] - a.back() * shape(c, i, j, k)));
  });
  double cross = 0, square = 0;
  for (std::size_t n = 1; n + 1 < a.size(); ++n) {
    cross += 0.5 * a[n] * (a[n + 1] + a[n - 1]);
    square += a[n] * a[n];
  }
  return std::acos(cross / square) / dt;
}

// Checks a wave in time: to 1e-6 (it reaches 1e-10) of the lattice's frequency with sin(omega' dt/2) = omega dt/2 of
// the leapfrog scheme, and of the continuum's c |k| to (k d)^2 / 8; P waves along an edge have the factor 1/24 exactly.
void check_wave(const model::Definition& definition, const mechanics::PeriodicLattice& lattice, const Vec3& phase,
                const Vec3& polarisation, double continuum_speed) {
  const Wave wave = wave_of(lattice, mechanics::node_inertia(rock.density, d), phase, polarisation);
  const double dt = 0.3 * d / rock.p_wave_speed();
  const double expected = 2 / dt * std::asin(0.5 * wave.omega * dt);
  double shape_error = 0;
  const double measured = frequency_in_time(definition, phase, wave, dt, 600, shape_error);
  EXPECT_NEAR(measured / expected, 1, 1e-6);
  EXPECT_LT(shape_error, 1e-9);
  EXPECT_GT(measured / wave.omega - 1, 1e-5);  // the time discretisation shows
  const double kd = norm(phase);
  EXPECT_NEAR(wave.omega / (continuum_speed * kd / d), 1, kd * kd / 8);
  EXPECT_GT(std::abs(wave.omega / (continuum_speed * kd / d) - 1), kd * kd / 400);
}

// A bar of 20 cells with free ends, half a wavelength long, periodic across: shared springs make the ends mirrors, so
// cos(pi x / L) is the lattice's own wave. P: omega = 2 c_p / d sin(k d / 2), because C1111 is exact. A shear wave
// bends planes; with node rotations its couple would have to vanish at a free end, so there the bar is a closed ring.
TEST_P(Waves, StandInABarAtTheLatticesOwnFrequency) {
  model::Definition bar = definition({20, 3, 3});
  bar.body.periodic = {false, true, true};
  const Vec3 phase{pi / 20, 0, 0};
  const auto lattice = periodic();
  check_wave(bar, lattice, phase, {1, 0, 0}, rock.p_wave_speed());
  const Wave p = wave_of(lattice, mechanics::node_inertia(rock.density, d), phase, {1, 0, 0});
  EXPECT_NEAR(p.omega / (2 * rock.p_wave_speed() / d * std::sin(pi / 40)), 1, 1e-12);

  if (GetParam().kinematics == Kinematics::rotational) {
    bar = definition({40, 3, 3});
    bar.body.periodic = {true, true, true};
  }
  check_wave(bar, lattice, phase, {0, 1, 0}, rock.s_wave_speed());
}

// Along [110] in a periodic box of 12 x 12 x 2 cells: k d = 2 pi / 12 (1, 1, 0), 8.5 cells per wavelength.
TEST_P(Waves, RunAlongTheFaceDiagonal) {
  model::Definition box = definition({12, 12, 2});
  box.body.periodic = {true, true, true};
  const double s = 1 / std::sqrt(2.0);
  const Vec3 phase{2 * pi / 12, 2 * pi / 12, 0};
  const auto lattice = periodic();
  check_wave(box, lattice, phase, {s, s, 0}, rock.p_wave_speed());
  check_wave(box, lattice, phase, {s, -s, 0}, rock.s_wave_speed());
  check_wave(box, lattice, phase, {0, 0, 1}, rock.s_wave_speed());
}

// Along [111] in a periodic box of 10 x 10 x 10 cells: 5.8 cells per wavelength.
TEST_P(Waves, RunAlongTheBodyDiagonal) {
  model::Definition box = definition({10, 10, 10});
  box.body.periodic = {true, true, true};
  const double s = 1 / std::sqrt(2.0), r = 1 / std::sqrt(3.0);
  const Vec3 phase{2 * pi / 10, 2 * pi / 10, 2 * pi / 10};
  const auto lattice = periodic();
  check_wave(box, lattice, phase, {r, r, r}, rock.p_wave_speed());
  check_wave(box, lattice, phase, {s, -s, 0}, rock.s_wave_speed());
}

// An undamped periodic box takes 0.9 of the lesser of d / c_p and the infinite lattice's 2 / omega_max: the step for
// which the validation page states its errors. The search for omega_max stays a little below it.
TEST_P(Waves, AutomaticStepIsThatOfTheInfiniteLattice) {
  model::Definition box = definition({8, 8, 8});
  box.body.periodic = {true, true, true};
  driver::Simulation simulation(box, Communicator::world());
  const double limit = std::min(d / rock.p_wave_speed(), 2 / std::sqrt(mechanics::scan_zone(periodic()).largest));
  EXPECT_NEAR(simulation.time_step() / (0.9 * limit), 1, 0.02);
}

INSTANTIATE_TEST_SUITE_P(Lattices, Waves,
                         testing::Values(Lattice{"bending_exact", CellType::cube_iii,
                                                 material::Calibration::bending_exact, Kinematics::rotational},
                                         Lattice{"bending_exact_fit", CellType::cube_iii,
                                                 material::Calibration::bending_exact, Kinematics::least_squares},
                                         Lattice{"cube_ii", CellType::cube_ii, material::Calibration::isotropic,
                                                 Kinematics::rotational},
                                         Lattice{"cube_i_fit", CellType::cube_i, material::Calibration::isotropic,
                                                 Kinematics::least_squares}),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace koshi
