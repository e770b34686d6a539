// Periodic bodies in motion whose mean strain is given, against closed forms, a chain of masses and their equilibrium.
#include <gtest/gtest.h>

#include <cmath>

#include "driver/simulation.h"
#include "mechanics/cell_stress.h"
#include "support/first_ranks.h"
#include "support/periodic_block.h"
#include "support/state_bits.h"

namespace koshi {
namespace {

using material::Elastic;
using mechanics::Tensor6;

constexpr double d = 0.01;
constexpr double dt = 1e-6;  // [s], below d / c_p = 2e-6 of the fastest of the three materials

model::Definition moving(const Int3& cells, int steps) {
  model::Definition definition = test::periodic_block(cells);
  definition.analysis.type = model::AnalysisDefinition::Type::dynamic;
  definition.analysis.time_step = dt;
  definition.analysis.duration = steps * dt;
  definition.analysis.damping.kind = model::DampingDefinition::Kind::none;
  definition.output.history_every = dt;
  return definition;
}

void strain(model::Definition& definition, const Tensor6& mean, const model::History& history) {
  model::MeanStrain components;
  for (std::size_t c = 0; c < 6; ++c) components.components[c] = mean[c];
  definition.macroscopic = model::MacroscopicDefinition{components, {}, history};
}

// Two layers of three and five cells along z.
void fill_layers(model::Definition& definition, const Int3& cells) {
  test::fill(definition, cells, [](const Int3& c) { return c[2] < 3 ? 1 : 2; });
}

TEST(MacroscopicMotion, OneMaterialFollowsItsStrainAtRest) {
  const Tensor6 mean{1e-3, -2e-4, 3e-4, 1e-4, -5e-4, 4e-4};
  model::Definition definition = moving({4, 3, 5}, 40);
  strain(definition, mean, {{0, 0.5}, {20 * dt, 1}, {30 * dt, -1}});
  driver::Simulation simulation(definition, Communicator::self());
  const Elastic& rock = test::three_elastics[0];
  const double trace = mean[0] + mean[1] + mean[2];
  int samples = 0;
  driver::Observer observer;
  observer.history = [&](const mechanics::Measurement& at, model::State& state) {
    const double factor = model::factor(definition.macroscopic->history, state.time);
    // Hooke: sigma = lambda tr(E) + 2 mu E. The elastic energy is V sigma : E / 2.
    double work = 0;
    for (std::size_t c = 0; c < 6; ++c) {
      const double stress = factor * ((c < 3 ? rock.lambda() * trace : 0) + 2 * rock.mu() * mean[c]);
      EXPECT_NEAR(at.mean->stress[c], stress, 1e-10 * rock.youngs_modulus * 1e-3) << state.step << " " << c;
      EXPECT_NEAR(at.mean->strain[c], factor * mean[c], 1e-16);
      work += (c < 3 ? 1 : 2) * stress * factor * mean[c];
    }
    const double energy = 0.5 * work * 4 * 3 * 5 * std::pow(d, 3);
    EXPECT_NEAR(at.balance.elastic_energy, energy, 1e-10 * rock.youngs_modulus * 1e-6 * std::pow(d, 3));
    EXPECT_LT(at.balance.kinetic_energy, 1e-20);
    ++samples;
  };
  simulation.run(observer);
  EXPECT_EQ(samples, 41);
}

// Layers stretched across are a chain of masses: between the planes of nodes the springs of a cell are M / d per area,
// a plane has half the mass of the two layers beside it, and the last spring leads to the first plane of the next
// image, which is E L further. Central differences on the rest of the displacement, by the same steps.
TEST(MacroscopicMotion, LayersMoveAsAChain) {
  const Int3 cells{2, 2, 8};
  constexpr int steps = 60, planes = 8;
  constexpr double mean = 1e-3;
  model::Definition definition = moving(cells, steps);
  fill_layers(definition, cells);
  const model::History history{{0, 0}, {10 * dt, 1}, {40 * dt, 1}, {50 * dt, 0.3}};
  strain(definition, {0, 0, mean}, history);
  driver::Simulation simulation(definition, Communicator::self());
  simulation.step(steps);

  std::array<double, planes> M{}, rho{}, v{}, u{};
  for (std::size_t k = 0; k < planes; ++k) {
    const Elastic& layer = test::three_elastics[k < 3 ? 0 : 1];
    M[k] = layer.lambda() + 2 * layer.mu();
    rho[k] = layer.density;
  }
  double strained = 0;
  for (int s = 0; s < steps; ++s) {
    std::array<double, planes> stress{};
    for (std::size_t k = 0; k < planes; ++k) {
      const double next = k + 1 < planes ? u[k + 1] : u[0] + strained * planes * d;
      stress[k] = M[k] * (next - u[k]) / d;
    }
    const double now = model::factor(history, (s + 1) * dt) * mean;
    for (std::size_t k = 0; k < planes; ++k) {
      const std::size_t below = (k + planes - 1) % planes;
      v[k] += dt * (stress[k] - stress[below]) / (0.5 * d * (rho[k] + rho[below]));
      u[k] += dt * v[k] + (now - strained) * static_cast<double>(k) * d;
    }
    strained = now;
  }
  const double size = mean * planes * d;
  const model::State& state = simulation.state();
  const lattice::Layout& layout = simulation.model().layout();
  double moved = 0;
  for (std::int64_t k = 0; k < planes; ++k) {
    const auto at = static_cast<std::size_t>(k);
    for (const auto& [i, j] : {std::array<std::int64_t, 2>{0, 0}, {1, 0}, {1, 1}}) {
      const std::int64_t n = layout.index(i, j, k);
      EXPECT_NEAR(state.displacement.component(2)[n], u[at], 1e-12 * size) << k;
      EXPECT_NEAR(state.velocity.component(2)[n], v[at], 1e-12 * size / dt) << k;
      EXPECT_NEAR(state.displacement.component(0)[n], 0, 1e-12 * size) << k;
    }
    moved = std::max(moved, std::abs(u[at] - strained * static_cast<double>(k) * d));
  }
  EXPECT_GT(moved, 0.01 * size);  // the layers did swing
}

TEST(MacroscopicMotion, EnergyIsTheWorkOfTheStrain) {
  const Int3 cells{3, 4, 8};
  constexpr int steps = 100;
  model::Definition definition = moving(cells, steps);
  test::fill(definition, cells, [](const Int3& c) { return c == Int3{1, 1, 1} ? 0 : 1 + (c[0] + c[1] * c[2]) % 3; });
  strain(definition, {1e-3, 0, 0, 0, 0, 5e-4}, {{0, 0.2}, {20 * dt, 1}, {40 * dt, 1}, {60 * dt, 0.5}});
  driver::Simulation simulation(definition, Communicator::self());
  std::vector<mechanics::Measurement> samples;
  driver::Observer observer;
  observer.history = [&](const mechanics::Measurement& at, model::State&) { samples.push_back(at); };
  simulation.run(observer);
  ASSERT_EQ(samples.size(), std::size_t{steps + 1});
  double expected = samples[0].balance.leapfrog_energy, kinetic = 0;
  for (std::size_t s = 1; s < samples.size(); ++s) {
    const mechanics::MeanState &before = *samples[s - 1].mean, &after = *samples[s].mean;
    // V (Sigma + Sigma') : (E' - E) / 2, with the forces of both ends of the step.
    for (std::size_t c = 0; c < 6; ++c)
      expected += 0.5 * std::pow(d, 3) * 3 * 4 * 8 * (c < 3 ? 1 : 2) * (before.stress[c] + after.stress[c]) *
                  (after.strain[c] - before.strain[c]);
    EXPECT_NEAR(samples[s].balance.leapfrog_energy / expected, 1, 1e-12) << s;
    kinetic = std::max(kinetic, samples[s].balance.kinetic_energy);
  }
  EXPECT_GT(kinetic, 1e-3 * expected);
}

TEST(MacroscopicMotion, DampedStepsEndInEquilibrium) {
  const Int3 cells{4, 3, 5};
  model::Definition definition = test::periodic_block(cells);
  test::fill(definition, cells,
             [](const Int3& c) { return (7 * c[0] + 3 * c[1] + 5 * c[2]) % 11 == 0 ? 0 : 1 + c[2] % 3; });
  strain(definition, {1e-3, 0, -2e-4, 3e-4, 0, 0}, {});
  driver::Simulation at_once(definition, Communicator::self());
  const mechanics::Measurement expected = at_once.run({}).measurement;
  definition.analysis.type = model::AnalysisDefinition::Type::quasi_static;
  definition.analysis.duration = 10000 * dt;
  definition.analysis.tolerance = 1e-8;
  strain(definition, {1e-3, 0, -2e-4, 3e-4, 0, 0}, {{0, 0}, {20 * dt, 1}});
  definition.analysis.damping = {model::DampingDefinition::Kind::local, 0.7, 0};
  driver::Simulation by_steps(definition, Communicator::self());
  const driver::Outcome outcome = by_steps.run({});
  EXPECT_TRUE(outcome.converged);
  for (std::size_t c = 0; c < 6; ++c)
    EXPECT_NEAR(outcome.measurement.mean->stress[c], expected.mean->stress[c], 1e-6 * expected.mean->stress[0]) << c;
  EXPECT_NEAR(outcome.measurement.balance.elastic_energy / expected.balance.elastic_energy, 1, 1e-7);
}

model::Definition swinging(int steps) {
  const Int3 cells{4, 8, 8};
  model::Definition definition = moving(cells, steps);
  test::fill(definition, cells, [](const Int3& c) { return (7 * c[0] + 3 * c[1] * c[1] + 5 * c[2]) % 4; });
  strain(definition, {1e-3, 0, 0, 0, 2e-4, 0}, {{0, 0.2}, {30 * dt, 1}});
  return definition;
}

TEST(MacroscopicMotion, GoesOnWhereItStopped) {
  driver::Simulation whole(swinging(40), Communicator::self());
  whole.step(40);
  driver::Simulation first(swinging(40), Communicator::self()), second(swinging(40), Communicator::self());
  first.step(15);
  second.state().displacement = first.state().displacement;
  second.state().velocity = first.state().velocity;
  second.state().time = first.state().time;
  second.state().step = first.state().step;
  second.step(25);
  EXPECT_EQ(test::bits_of(second), test::bits_of(whole));
}

TEST(MacroscopicMotion, SameBitsOnAnyRanks) {
  driver::Simulation alone(swinging(40), Communicator::self());
  alone.step(40);
  int compared = 0;
  for (const int ranks : {2, 4}) {
    const auto group = test::first_ranks(ranks);
    if (!group) continue;
    driver::Simulation together(swinging(40), *group);
    together.step(40);
    EXPECT_EQ(test::bits_of(together), test::bits_of(alone));
    EXPECT_EQ(together.measure().mean->stress, alone.measure().mean->stress);
    ++compared;
  }
  EXPECT_EQ(Communicator::world().sum(std::int64_t{compared}), 2 + 4);
}

}  // namespace
}  // namespace koshi
