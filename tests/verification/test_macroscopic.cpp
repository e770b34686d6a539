// Periodic bodies whose mean strain or mean stress is given, against closed forms and their effective stiffness.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "driver/fields.h"
#include "driver/simulation.h"
#include "koshi/error.h"
#include "mechanics/cell_stress.h"
#include "mechanics/uniform_strain.h"
#include "support/first_ranks.h"
#include "support/periodic_block.h"

namespace koshi {
namespace {

using material::Elastic;
using mechanics::Tensor6;
using testing::HasSubstr;
using testing::ThrowsMessage;

using Components = std::array<std::optional<double>, 6>;

constexpr std::optional<double> none;

model::MacroscopicDefinition macroscopic(const Components& strain, const Components& stress) {
  model::MacroscopicDefinition definition;
  definition.strain = model::MeanStrain{strain};
  definition.stress = model::MeanStress{stress};
  return definition;
}

// A run of the whole program's path: solve, measure.
struct Strained {
  explicit Strained(const model::Definition& definition, const Communicator& communicator = Communicator::self())
      : simulation(definition, communicator), outcome(simulation.run({})) {}
  const statics::Macroscopic& whole() const { return *outcome.solution->macroscopic; }
  driver::Simulation simulation;
  driver::Outcome outcome;
};

// A mixture of three materials and voids without any symmetry; the voids touch none of their kind.
model::Definition mixture(const Int3& cells = {6, 4, 5}) {
  model::Definition definition = test::periodic_block(cells);
  test::fill(definition, cells, [](const Int3& c) {
    const std::int64_t at = (7 * c[0] + 3 * c[1] * c[1] + 5 * c[2] + c[0] * c[2]) % 11;
    return at == 0 ? 0 : 1 + at % 3;
  });
  return definition;
}

// C times a strain whose shears are those of the tensor.
Tensor6 times(const material::ElasticTensor& C, const Tensor6& strain) {
  Tensor6 stress{};
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j) stress[i] += C.voigt[i][j] * (j < 3 ? 1 : 2) * strain[j];
  return stress;
}

TEST(Macroscopic, OneMaterialHasTheStressOfItsStrain) {
  // A uniform strain is an equilibrium of every calibrated lattice: stress C E in the mean and in each cell, energy
  // E : C : E / 2 by volume, displacements E x from the lower corner, no iterations.
  model::Definition definition = test::periodic_block({5, 4, 6});
  const Tensor6 strain{1e-3, -2e-3, 5e-4, 3e-4, -7e-4, 1.1e-3};
  Components given;
  for (std::size_t c = 0; c < 6; ++c) given[c] = strain[c];
  definition.macroscopic = macroscopic(given, {});
  Strained found(definition);
  const Tensor6 stress = times(material::elastic_tensor(test::three_elastics[0]), strain);
  double work = 0;
  for (std::size_t c = 0; c < 6; ++c) {
    EXPECT_NEAR(found.whole().stress[c] / stress[0], stress[c] / stress[0], 1e-10) << c;
    EXPECT_EQ(found.whole().strain[c], strain[c]);
    work += (c < 3 ? 1 : 2) * strain[c] * stress[c];
  }
  EXPECT_EQ(found.whole().solves, 1);
  EXPECT_EQ(found.outcome.solution->iterations, 0);
  const double volume = 0.05 * 0.04 * 0.06;
  EXPECT_NEAR(found.outcome.measurement.balance.elastic_energy / (0.5 * volume * work), 1, 1e-10);

  const model::Model& model = found.simulation.model();
  const lattice::Field<double>& u = found.simulation.state().displacement;
  int nodes = 0;
  const Int3& owned = model.layout().owned();
  lattice::for_each(model.layout(), {-1, -1, -1}, {owned[0] + 1, owned[1] + 1, owned[2] + 1},
                    [&](auto i, auto j, auto k, auto n) {
                      const Vec3 expected = mechanics::uniform_displacement(model, strain, {i, j, k});
                      for (int c = 0; c < 3; ++c)
                        EXPECT_NEAR(u.component(c)[n], expected[static_cast<std::size_t>(c)], 1e-15);
                      ++nodes;
                    });
  EXPECT_EQ(nodes, 7 * 6 * 8);  // ghosts are on the far side of the periods
}

TEST(Macroscopic, LayersShareTheStressAcrossThem) {
  // Two materials in layers across z under E_zz alone: the same stress in both, 1 / <1 / (lambda + 2 mu)> times E_zz
  // (Backus 1962). Least-squares springs have it exactly.
  const Int3 cells{2, 3, 8};
  model::Definition definition = test::periodic_block(cells);
  definition.lattice.kinematics = material::Kinematics::least_squares;
  test::fill(definition, cells, [](const Int3& c) { return c[2] < 4 ? 1 : 2; });
  definition.macroscopic = macroscopic({none, none, 1e-3}, {});
  Strained found(definition);
  const auto modulus = [](const Elastic& e) { return e.lambda() + 2 * e.mu(); };
  const double stress = 1e-3 / (0.5 / modulus(test::three_elastics[0]) + 0.5 / modulus(test::three_elastics[1]));
  EXPECT_NEAR(found.whole().stress[2] / stress, 1, 1e-8);
  int compared = 0;
  const model::Model& model = found.simulation.model();
  lattice::for_each_owned(model.layout(), [&](auto, auto, auto, auto n) {
    const auto cell = mechanics::cell_state(model.lattice, found.simulation.state().displacement, n);
    EXPECT_NEAR(cell.stress[2] / stress, 1, 1e-8);
    ++compared;
  });
  EXPECT_EQ(compared, 2 * 3 * 8);
}

TEST(Macroscopic, AgreesWithTheEffectiveStiffness) {
  // The mean stress is C E and the energy V E : C : E / 2, C from koshi homogenize; the energy is also that of the
  // cells, one by one.
  model::Definition definition = mixture();
  const homogenize::Effective effective = test::effective(definition, Communicator::self());
  const Tensor6 strain{1e-3, -2e-3, 5e-4, 3e-4, -7e-4, 1.1e-3};
  Components given;
  for (std::size_t c = 0; c < 6; ++c) given[c] = strain[c];
  definition.macroscopic = macroscopic(given, {});
  Strained found(definition);
  const Tensor6 stress = times(effective.stiffness, strain);
  double work = 0;
  for (std::size_t c = 0; c < 6; ++c) {
    EXPECT_NEAR(found.whole().stress[c] / stress[0], stress[c] / stress[0], 1e-8) << c;
    work += (c < 3 ? 1 : 2) * strain[c] * stress[c];
  }
  const model::Model& model = found.simulation.model();
  const double volume = std::pow(0.01, 3) * 6 * 4 * 5;
  EXPECT_NEAR(found.outcome.measurement.balance.elastic_energy / (0.5 * volume * work), 1, 1e-8);
  EXPECT_LT(found.outcome.measurement.balance.unbalanced_ratio(), 1e-9);
  EXPECT_GT(found.outcome.measurement.balance.unbalanced_ratio(), 0);
  double energy = 0;
  lattice::for_each_owned(model.layout(), [&](auto, auto, auto, auto n) {
    if (model.lattice.cell.component(0)[n] != 0)
      energy += mechanics::cell_state(model.lattice, found.simulation.state().displacement, n).energy;
  });
  EXPECT_NEAR(energy * std::pow(0.01, 3) / (0.5 * volume * work), 1, 1e-8);
}

TEST(Macroscopic, UniaxialStressGivesYoungsModulusAndPoissonsRatio) {
  model::Definition definition = test::periodic_block({4, 3, 5});
  definition.macroscopic = macroscopic({}, {0, 0, 2e6, 0, 0, 0});
  Strained found(definition);
  const Elastic& rock = test::three_elastics[0];
  const double strain = 2e6 / rock.youngs_modulus;
  const double nu = rock.poissons_ratio;
  const Tensor6 expected{-nu * strain, -nu * strain, strain, 0, 0, 0};
  for (std::size_t c = 0; c < 6; ++c) {
    EXPECT_NEAR(found.whole().strain[c] / strain, expected[c] / strain, 1e-10) << c;
    EXPECT_NEAR(found.whole().stress[c] / 2e6, c == 2 ? 1 : 0, 1e-10) << c;
  }
  EXPECT_EQ(found.whole().solves, 8);  // six strains, none of them, all of them
}

TEST(Macroscopic, MixedControlMeetsBoth) {
  // Of the six components two strains and two stresses are given, the others have no strain: what is found has the
  // stress C E.
  model::Definition definition = mixture();
  const homogenize::Effective effective = test::effective(definition, Communicator::self());
  definition.macroscopic = macroscopic({1e-3, none, none, none, none, 4e-4}, {none, -3e6, none, 1e6});
  definition.macroscopic->history = {{0, 0}, {2, 0.5}};
  Strained found(definition);
  const statics::Macroscopic& whole = found.whole();
  // The history ends at half of both.
  EXPECT_EQ(whole.strain[0], 5e-4);
  EXPECT_EQ(whole.strain[5], 2e-4);
  EXPECT_EQ(whole.strain[2], 0);
  EXPECT_EQ(whole.strain[4], 0);
  EXPECT_NEAR(whole.stress[1], -1.5e6, 1.5);
  EXPECT_NEAR(whole.stress[3], 0.5e6, 0.5);
  const Tensor6 stress = times(effective.stiffness, whole.strain);
  for (std::size_t c = 0; c < 6; ++c) EXPECT_NEAR(whole.stress[c] / stress[0], stress[c] / stress[0], 1e-7) << c;
}

TEST(Macroscopic, APlateUnderPressureIsInPlaneStrainAndStress) {
  // Periodic in x and y, pressed on from above, held below where z is smooth: sigma_zz = -p, E_xx given, E_yy = E_xy =
  // 0 or sigma_yy = 0. Hooke: E_yy = 0: sigma_xx - sigma_yy = 2 mu E_xx and E_zz = (-p - lambda E_xx) / (lambda + 2
  // mu).
  const double p = 4e6, e = 2e-4;
  const Elastic& rock = test::three_elastics[0];
  model::Definition definition = test::periodic_block({4, 4, 6});
  definition.body.periodic = {true, true, false};
  definition.boundaries = {test::fixed("floor", model::Face::z_min, {2, 3, 4})};
  definition.loads.resize(1);
  definition.loads[0].name = "lid";
  definition.loads[0].selection.face = model::Face::z_max;
  definition.loads[0].pressure = p;
  definition.macroscopic = macroscopic({e}, {});
  Strained plane(definition);
  const double lambda = rock.lambda(), mu = rock.mu();
  const double zz = (-p - lambda * e) / (lambda + 2 * mu);
  EXPECT_NEAR(plane.whole().stress[0] / p, (2 * mu * e + lambda * (e + zz)) / p, 1e-8);
  EXPECT_NEAR(plane.whole().stress[1] / p, lambda * (e + zz) / p, 1e-8);
  EXPECT_NEAR(plane.whole().stress[2] / p, -1, 1e-8);

  // sigma_yy = 0: E E_yy = -nu (sigma_xx - p), E e = sigma_xx + nu p.
  definition.macroscopic = macroscopic({e}, {none, 0});
  Strained free(definition);
  const double xx = rock.youngs_modulus * e - rock.poissons_ratio * p;
  EXPECT_NEAR(free.whole().stress[0] / p, xx / p, 1e-8);
  EXPECT_NEAR(free.whole().stress[1] / p, 0, 1e-8);
  EXPECT_NEAR(free.whole().strain[1] / e, -rock.poissons_ratio * (xx - p) / rock.youngs_modulus / e, 1e-8);
}

TEST(Macroscopic, WhatIsPartedHasNoStrainForAStress) {
  // A whole layer of voids: nothing carries sigma_zz, nor the shears across it.
  const Int3 cells{3, 3, 4};
  model::Definition definition = test::periodic_block(cells);
  test::fill(definition, cells, [](const Int3& c) { return c[2] == 0 ? 0 : 1; });
  definition.macroscopic = macroscopic({}, {1e6, none, 1e6});
  EXPECT_THAT([&] { Strained found(definition); },
              ThrowsMessage<RunError>(HasSubstr("the body gives way to zz without end")));
  definition.macroscopic = macroscopic({1e-3, none, 1e-3}, {});
  EXPECT_NEAR(Strained(definition).whole().stress[2], 0, 1e-3);
}

TEST(Macroscopic, SameBitsOnAnyRanks) {
  model::Definition definition = mixture({4, 8, 8});
  definition.macroscopic = macroscopic({1e-3, none, none, none, none, 4e-4}, {none, -3e6, none, 1e6});
  Strained alone(definition);
  int compared = 0;
  for (const int ranks : {2, 4}) {
    const auto group = test::first_ranks(ranks);
    if (!group) continue;
    Strained together(definition, *group);
    EXPECT_EQ(together.whole().strain, alone.whole().strain);
    EXPECT_EQ(together.whole().stress, alone.whole().stress);
    EXPECT_EQ(together.outcome.measurement.balance.elastic_energy, alone.outcome.measurement.balance.elastic_energy);
    // Every node of this rank against the same node of the one that has all, ghosts too.
    const model::Model& model = together.simulation.model();
    const lattice::Layout& all = alone.simulation.model().layout();
    const auto& expected = alone.simulation.state().displacement;
    const Int3& owned = model.layout().owned();
    std::int64_t equal = 0;
    lattice::for_each(
        model.layout(), {-1, -1, -1}, {owned[0] + 1, owned[1] + 1, owned[2] + 1}, [&](auto i, auto j, auto k, auto n) {
          const Int3 node = model.layout().global({i, j, k});
          const std::int64_t at = all.index(node[0], node[1], node[2]);
          for (int c = 0; c < 6; ++c)
            equal += together.simulation.state().displacement.component(c)[n] == expected.component(c)[at];
        });
    EXPECT_EQ(equal, 6 * (owned[0] + 2) * (owned[1] + 2) * (owned[2] + 2));
    ++compared;
  }
  EXPECT_EQ(Communicator::world().sum(std::int64_t{compared}), 2 + 4);
}

}  // namespace
}  // namespace koshi
