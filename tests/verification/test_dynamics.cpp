// Free flight, energy and damping of the explicit motion, against the discrete solutions of the leapfrog scheme.
#include "koshi/dynamics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "mechanics/force_kernel.h"
#include "mechanics/measure.h"
#include "support/cases.h"

namespace koshi {
namespace {

using material::Kinematics;
using Damping = model::DampingDefinition;

double random_velocity(std::mt19937& random) { return std::uniform_real_distribution<double>(-1, 1)(random); }

/// A model with its state; velocities start at random, rotational ones over the spacing.
struct Flight {
  model::Model model;
  model::State state;

  explicit Flight(const model::Definition& definition)
      : model(model::make_model(definition, Communicator::world())), state(model) {
    std::mt19937 random(3);
    for_each_unknown([&](int c, std::int64_t n, double inertia) {
      if (inertia > 0) state.velocity.component(c)[n] = random_velocity(random) / (c < 3 ? 1 : model.lattice.grid.d);
    });
  }

  template <class F>
  void for_each_unknown(F&& f) const {
    lattice::for_each_owned(model.layout(), [&](auto, auto, auto, auto n) {
      for (int c = 0; c < model.components(); ++c) f(c, n, model.inertia.component(c < 3 ? 0 : 1)[n]);
    });
  }

  /// Linear and angular momentum. The lattice is linear, so its moments are taken about the undeformed positions.
  std::array<double, 6> momentum() const {
    std::array<double, 6> P{};
    lattice::for_each_owned(model.layout(), [&](auto i, auto j, auto k, auto n) {
      Vec3 p{}, spin{};
      for (int c = 0; c < model.components(); ++c)
        (c < 3 ? p : spin)[static_cast<std::size_t>(c % 3)] =
            model.inertia.component(c < 3 ? 0 : 1)[n] * state.velocity.component(c)[n];
      const Vec3 L = cross(model.lattice.grid.position({i, j, k}), p) + spin;
      for (std::size_t c = 0; c < 3; ++c) {
        P[c] += p[c];
        P[3 + c] += L[c];
      }
    });
    return P;
  }
};

model::Definition small_block(Kinematics kinematics) {
  model::Definition definition = test::block({3, 2, 2}, 0.1, {50, 0.3, 3});
  definition.lattice.kinematics = kinematics;
  return definition;
}

class Motion : public testing::TestWithParam<Kinematics> {};

// Internal forces and moments have no resultant, so both momenta, of order 1e-3, stay what they were. The body drifts
// by some metres, so a force k u rounds by about 5 N/m x 10 m x 1e-16, an impulse of 3e-18 N s a step, 5e-15 in all.
TEST_P(Motion, ConservesMomentumAndAngularMomentumInFreeFlight) {
  Flight flight(small_block(GetParam()));
  const auto before = flight.momentum();
  dynamics::ExplicitSolver solver(flight.model, flight.state, 0.005);
  for (int step = 0; step < 2000; ++step) solver.step();
  const auto after = flight.momentum();
  double size = 0;
  for (std::size_t c = 0; c < 6; ++c) {
    EXPECT_NEAR(after[c], before[c], 1e-14) << "component " << c;
    size = std::max(size, std::abs(before[c]));
  }
  EXPECT_GT(size, 1e-4);
}

// The leapfrog scheme conserves 1/2 v-.M v+ + V(u) exactly: with v+ = v- + a dt, u' = u + v+ dt and M a = -K u the
// difference of two successive values vanishes identically. The energy itself only oscillates around it. One face is
// held, for a body that drifts away would lose digits of its strains.
TEST_P(Motion, ConservesEnergyOverAHundredThousandSteps) {
  model::Definition definition = small_block(GetParam());
  definition.boundaries = {test::fixed("wall", model::Face::x_min, {0, 1, 2, 3, 4, 5})};
  Flight flight(definition);
  for (const model::PrescribedMotion& held : flight.model.motions)
    flight.state.velocity.component(held.component)[held.node] = 0;
  mechanics::ForceKernel kernel(flight.model.lattice);
  lattice::Field<double> force(flight.model.layout(), flight.model.components());
  dynamics::ExplicitSolver solver(flight.model, flight.state, 0.005);

  // One step, and the energies at its start: {conserved, mean of the half steps' kinetic energy plus elastic energy}.
  const auto energies = [&] {
    const lattice::Field<double> before = flight.state.velocity;
    kernel.apply(flight.state.displacement, force);
    double elastic = 0, conserved = 0, kinetic = 0;
    flight.for_each_unknown([&](int c, std::int64_t n, double) {
      elastic -= 0.5 * flight.state.displacement.component(c)[n] * force.component(c)[n];
    });
    solver.step();
    flight.for_each_unknown([&](int c, std::int64_t n, double inertia) {
      const double v0 = before.component(c)[n], v1 = flight.state.velocity.component(c)[n];
      conserved += 0.5 * inertia * v0 * v1;
      kinetic += 0.25 * inertia * (v0 * v0 + v1 * v1);
    });
    return std::array<double, 3>{conserved + elastic, kinetic + elastic, elastic};
  };

  const double first = energies()[0];
  double lowest = first, highest = first, largest_swing = 0, elastic_part = 0;
  for (int sample = 0; sample < 100; ++sample) {
    for (int step = 0; step < 999; ++step) solver.step();
    const auto [conserved, energy, elastic] = energies();
    lowest = std::min(lowest, conserved);
    highest = std::max(highest, conserved);
    largest_swing = std::max(largest_swing, std::abs(energy / first - 1));
    elastic_part = std::max(elastic_part, elastic / first);
  }
  EXPECT_EQ(flight.state.step, 100'001);
  EXPECT_NEAR(lowest / first, 1, 1e-11);
  EXPECT_NEAR(highest / first, 1, 1e-11);
  mechanics::Meter meter(flight.model, kernel);
  EXPECT_NEAR(meter.balance(flight.state, 0.005).leapfrog_energy / first, 1, 1e-11);
  EXPECT_LT(largest_swing, 0.5);
  EXPECT_GT(largest_swing, 1e-3);  // the step is coarse enough for the two energies to differ
  EXPECT_GT(elastic_part, 0.1);    // and the body does deform
}

INSTANTIATE_TEST_SUITE_P(Both, Motion, testing::Values(Kinematics::rotational, Kinematics::least_squares));

/// A standing P wave u_x = a cos(k x), one wavelength in a periodic box of 20 cells: every node follows a'' = -omega^2
/// a with omega = 2 c_p / d sin(k d / 2), whatever the springs (C1111 is exact and only planes move against planes).
struct StandingWave {
  static constexpr std::int64_t cells = 20;
  static constexpr double d = 0.05, dt = 0.002;
  material::Elastic elastic{50, 0.3, 3};
  model::Definition definition = test::block({cells, 3, 3}, d, elastic);
  double omega = 2 * elastic.p_wave_speed() / d * std::sin(std::numbers::pi / cells);

  explicit StandingWave(const Damping& damping) {
    definition.body.periodic = {true, true, true};
    definition.analysis.damping = damping;
  }

  /// Amplitudes a_0 ... a_steps for a_0 = 1 and the velocity v0 half a step before.
  std::vector<double> run(double v0, int steps) const {
    const model::Model model = model::make_model(definition, Communicator::world());
    model::State state(model);
    lattice::for_each_owned(model.layout(), [&](auto i, auto, auto, auto n) {
      const double shape = std::cos(2 * std::numbers::pi * static_cast<double>(i) / cells);
      state.displacement.component(0)[n] = shape;
      state.velocity.component(0)[n] = v0 * shape;
    });
    dynamics::ExplicitSolver solver(model, state, dt);
    const std::int64_t crest = model.layout().index(0, 1, 2);
    std::vector<double> a{1};
    for (int step = 0; step < steps; ++step) {
      solver.step();
      a.push_back(state.displacement.component(0)[crest]);
    }
    return a;
  }
};

// Viscous damping c/m = r: u(n+1) - 2 u(n) + u(n-1) + r dt/2 (u(n+1) - u(n-1)) + omega^2 dt^2 u(n) = 0, so u(n) = Re
// z^n with |z|^2 = (1 - r dt/2) / (1 + r dt/2) and Re z = (1 - omega^2 dt^2 / 2) / (1 + r dt/2). The continuum decays
// by exp(-r/2 t), which |z|^n meets to r^3 dt^2 t / 24.
TEST(Damping, ViscousDecaysAtTheRateOfTheScheme) {
  const double rate = 1.5;
  const StandingWave wave({Damping::Kind::viscous, 0, rate});
  const double c = 0.5 * rate * wave.dt, w2 = wave.omega * wave.omega * wave.dt * wave.dt;
  const double modulus = std::sqrt((1 - c) / (1 + c)), angle = std::acos((1 - 0.5 * w2) / (1 + c) / modulus);
  const int steps = 2000;
  // a(-1) = |z|^-1 cos(angle) starts the solution a(n) = |z|^n cos(n angle).
  const auto a = wave.run((1 - std::cos(angle) / modulus) / wave.dt, steps);
  for (int n = 0; n <= steps; ++n) EXPECT_NEAR(a[n], std::pow(modulus, n) * std::cos(n * angle), 1e-11) << n;
  EXPECT_NEAR(std::pow(modulus, steps), std::exp(-0.5 * rate * steps * wave.dt), 1e-5);
  EXPECT_LT(std::pow(modulus, steps), 0.1);
}

// Without force a body under local damping flies on; under viscous damping it slows down by (1 - c) / (1 + c) a step.
TEST(Damping, ActsOnRigidFlightAsItsFormSays) {
  for (const auto kind : {Damping::Kind::none, Damping::Kind::local, Damping::Kind::viscous}) {
    model::Definition definition = test::block({2, 1, 1}, 0.5, {10, 0.2, 1});
    definition.analysis.damping = {kind, 0.8, 0.4};
    const model::Model model = model::make_model(definition, Communicator::world());
    model::State state(model);
    lattice::for_each_owned(model.layout(), [&](auto, auto, auto, auto n) { state.velocity.component(1)[n] = 0.25; });
    dynamics::ExplicitSolver solver(model, state, 0.015625);
    for (int step = 0; step < 64; ++step) solver.step();
    const double c = 0.5 * 0.4 * 0.015625;
    const double expected = kind == Damping::Kind::viscous ? 0.25 * std::pow((1 - c) / (1 + c), 64) : 0.25;
    lattice::for_each_owned(model.layout(), [&](auto, auto, auto, auto n) {
      EXPECT_NEAR(state.velocity.component(1)[n], expected, 1e-14);
      EXPECT_NEAR(state.velocity.component(0)[n], 0, 1e-14);
    });
  }
}

// Local damping (N27) keeps the wave's shape, because force and velocity have it: a'' = -omega^2 (a + alpha |a| sign
// a'). Its own recursion gives every amplitude; each half swing loses work alpha k (A1^2 + A2^2) / 2 of the energy k
// (A1^2 - A2^2) / 2, so that A2 / A1 = sqrt((1 - alpha) / (1 + alpha)).
TEST(Damping, LocalShrinksEachSwingByAFixedRatio) {
  const double alpha = 0.3;
  const StandingWave wave({Damping::Kind::local, alpha, 0});
  const int steps = 1000;
  const auto a = wave.run(0, steps);
  double u = 1, v = 0;
  const double dt = wave.dt;
  std::vector<double> turns;
  for (int n = 1; n <= steps; ++n) {
    const double f = -wave.omega * wave.omega * u;
    v += dt * (f - alpha * std::abs(f) * (v > 0 ? 1 : v < 0 ? -1 : 0));
    u += dt * v;
    EXPECT_NEAR(a[n], u, 1e-11) << n;
    if (n > 1 && (a[n] - a[n - 1]) * (a[n - 1] - a[n - 2]) < 0) turns.push_back(std::abs(a[n - 1]));
  }
  ASSERT_GE(turns.size(), 6U);
  for (std::size_t t = 1; t < 6; ++t)
    EXPECT_NEAR(turns[t] / turns[t - 1], std::sqrt((1 - alpha) / (1 + alpha)), 0.01) << t;
}

}  // namespace
}  // namespace koshi
