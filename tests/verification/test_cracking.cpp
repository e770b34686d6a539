// Bodies that crack (theory, section 12): the strength and the energy asked for, and where the energy of a run goes.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <tuple>

#include "driver/simulation.h"
#include "failure/cracking.h"
#include "failure/row_reach.h"
#include "support/cases.h"
#include "support/watched_run.h"

namespace koshi {
namespace {

using test::watch;
using test::Watched;

constexpr double degrees = std::numbers::pi / 180;
const material::Elastic concrete{30e9, 0.2, 2400};

material::Fracture fracture() {
  material::Fracture fracture;
  fracture.tensile_strength = 3e6;
  fracture.fracture_energy = 100;
  fracture.softening = material::Softening::linear;
  return fracture;
}

Vec3 unit(const Vec3& v) { return (1 / norm(v)) * v; }

// Strain of the stress `axial` along n and -p across.
failure::Tensor6 strain_of(double axial, double p, const Vec3& n) {
  const double E = concrete.youngs_modulus, nu = concrete.poissons_ratio;
  const double trace = axial - 2 * p;
  constexpr std::array<std::array<std::size_t, 2>, 6> pairs{{{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}};
  failure::Tensor6 strain;
  for (std::size_t v = 0; v < 6; ++v) {
    const auto [i, j] = pairs[v];
    const double one = i == j ? 1 : 0, stress = (axial + p) * n[i] * n[j] - p * one;
    strain[v] = ((1 + nu) * stress - nu * trace * one) / E;
  }
  return strain;
}

// Gives a block this even strain.
void stretch(const model::Model& model, model::State& state, const failure::Tensor6& e) {
  lattice::for_each(model.layout(), {-1, -1, -1}, model.layout().owned(), [&](auto i, auto j, auto k, auto n) {
    const Vec3 x = model.lattice.grid.position(model.layout().global({i, j, k}));
    const Vec3 u = failure::times(e, x);
    for (int c = 0; c < 3; ++c) state.displacement.component(c)[n] = u[static_cast<std::size_t>(c)];
  });
}

// Whether a block under this even strain cracks, and that it does so in all cells or in none.
bool cracks(model::Model& model, const failure::Tensor6& e) {
  model::make_factors(model.lattice, [](const Int3&) { return 1.0F; });  // the last one may have cracked it
  model::State state(model);
  failure::Cracking cracking(model, state);
  stretch(model, state, e);
  cracking.follow(1e-9);
  std::int64_t cracked = 0;
  lattice::for_each_owned(model.layout(),
                          [&](auto, auto, auto, auto n) { cracked += state.crack.component(1)[n] > 0; });
  EXPECT_TRUE(cracked == 0 || cracked == model.cell_count) << cracked;
  return cracked != 0;
}

// The stress along n at which the block cracks, by halving.
double strength(model::Model& model, double sign, double p, const Vec3& n) {
  double low = 0, high = 400e6;
  for (int halving = 0; halving < 40; ++halving) {
    const double middle = 0.5 * (low + high);
    (cracks(model, strain_of(sign * middle, p, n)) ? high : low) = middle;
  }
  return low;
}

const std::array<Vec3, 5> directions{Vec3{1, 0, 0}, Vec3{1, 1, 0}, Vec3{1, 1, 1}, Vec3{3, 2, 1}, Vec3{-1, 5, 2}};

// Even tension along any direction cracks the lattice at f_t, with both kinematics: to the bisection's 1e-9, where the
// task allows 2 %.
TEST(Cracking, TensileStrengthHasNoDirection) {
  for (const auto kinematics : {material::Kinematics::rotational, material::Kinematics::least_squares}) {
    model::Definition definition = test::block({3, 2, 2}, 0.01, concrete);
    definition.lattice.kinematics = kinematics;
    definition.materials[0].fracture = fracture();
    model::Model model = model::make_model(definition, Communicator::world());
    for (const Vec3& v : directions) EXPECT_NEAR(strength(model, 1, 0, unit(v)) / 3e6, 1, 1e-6);
  }
}

// Columns under confining pressure p crack at 2 c sqrt(m) + m p, m = tan^2(45 + phi/2).
TEST(Cracking, ConfinedCompression) {
  model::Definition definition = test::block({3, 2, 2}, 0.01, concrete);
  definition.materials[0].fracture = fracture();
  definition.materials[0].fracture->cohesion = 8e6;
  definition.materials[0].fracture->friction_angle = 40 * degrees;
  model::Model model = model::make_model(definition, Communicator::world());
  const double m = std::pow(std::tan(65 * degrees), 2);
  for (const double p : {0.0, 5e6, 20e6})
    for (const Vec3& v : directions)
      EXPECT_NEAR(strength(model, -1, p, unit(v)) / (2 * 8e6 * std::sqrt(m) + m * p), 1, 1e-6) << p;
}

// Cells with a factor of half their springs crack at the same strain and lose half the energy; cells without springs
// have nothing to lose. By 1e-6 beyond the strength a cell of softening on a line has lost about 2e-6 R/(R - 1) of its
// springs: positive, finite and small.
TEST(Cracking, FactorsOnTheStiffnessCount) {
  model::Definition definition = test::block({3, 2, 2}, 0.01, concrete);
  definition.materials[0].fracture = fracture();
  definition.body.factors = {1, 0.5, 0, 1, 0.5, 0, 1, 0.5, 0, 1, 0.5, 0};
  model::Model model = model::make_model(definition, Communicator::world());
  model::State state(model);
  failure::Cracking cracking(model, state);
  stretch(model, state, strain_of(3e6 * (1 + 1e-6), 0, {1, 0, 0}));
  cracking.follow(1e-9);
  std::array<double, 3> lost{};
  lattice::for_each_owned(model.layout(), [&](auto i, auto, auto, auto n) {
    if (i == 3) return;
    EXPECT_EQ(state.crack.component(0)[n] > 0, i < 2 && model.lattice.cell.component(0)[n] != 0);
    lost[static_cast<std::size_t>(i)] += state.crack.component(12)[n];
  });
  EXPECT_GT(lost[0], 0);
  EXPECT_LT(lost[0], 4e-6 * 4 * 1e-6 * 0.5 * 3e6 * 1e-4);
  EXPECT_NEAR(lost[1] / lost[0], 0.5, 1e-6);
  EXPECT_EQ(lost[2], 0);
}

// Cells that are weaker crack earlier, by their factor on the strength: of layers with 0.5, 1 and 2 times f_t, those
// crack that the tension has reached.
TEST(Cracking, FactorsOnTheStrengthCount) {
  model::Definition definition = test::block({3, 2, 2}, 0.01, concrete);
  definition.materials[0].fracture = fracture();
  definition.body.strengths = {0.5, 1, 2, 0.5, 1, 2, 0.5, 1, 2, 0.5, 1, 2};
  for (const auto& [tension, layers] : {std::pair{1.4e6, 0}, {1.6e6, 1}, {2.9e6, 1}, {3.1e6, 2}, {6.1e6, 3}}) {
    model::Model model = model::make_model(definition, Communicator::world());
    model::State state(model);
    failure::Cracking cracking(model, state);
    stretch(model, state, strain_of(tension, 0, {1, 0, 0}));
    cracking.follow(1e-9);
    lattice::for_each_owned(model.layout(), [&](auto i, auto, auto, auto n) {
      if (model.lattice.cell.component(0)[n] != 0) EXPECT_EQ(state.crack.component(1)[n] > 0, i < layers) << tension;
    });
  }
}

// A bar along x with a weaker layer of cells in the middle, held and pulled by smooth platens.
model::Definition bar(double d, material::Kinematics kinematics) {
  model::Definition definition =
      test::block({std::llround(0.08 / d), std::llround(0.01 / d), std::llround(0.01 / d)}, d, concrete);
  definition.materials[0].fracture = fracture();
  definition.materials.push_back({"weak", concrete, fracture()});
  definition.materials[1].fracture->tensile_strength = 2.7e6;
  model::RegionDefinition layer;
  layer.material = "weak";
  layer.min = {0.04, 0, 0};
  layer.max = {0.04 + d, 0.01, 0.01};
  definition.regions = {layer};
  model::BoundaryDefinition pull = test::fixed("pull", model::Face::x_max, {4, 5});
  pull.displacement[0] = 1e-4;
  definition.boundaries = {test::fixed("wall", model::Face::x_min, {0, 4, 5}), pull};
  definition.lattice.kinematics = kinematics;
  if (kinematics == material::Kinematics::least_squares)  // nodes that do not turn need not be held
    for (auto& boundary : definition.boundaries) boundary.fix[4] = boundary.fix[5] = false;
  definition.probes = {test::probe("force", model::Face::x_max, model::ProbeDefinition::Quantity::reaction,
                                   model::ProbeDefinition::Reduce::sum)};
  definition.analysis.duration = 4e-3;
  definition.output.history_every = 2e-5;
  return definition;
}

// The weak layer breaks at its strength and takes G_f for its area, whatever the spacing. It cracks at 2.7e6/30e9 80 mm
// = 7.2 um and has opened at 2 G_f/f_t = 74 um. A platen that gets faster by v sends a wave of rho c v = 8.5 MPa s/m
// times v, which stays in the bar: when it cracks those of 1.3 mm/s are 0.4 % of the strength, those of 2.2 mm/s that
// follow 0.7 %. The finest bar is pulled three times as fast. Nodes with rotations of their own turn along the edges of
// a crack, as along those of a smooth platen (theory, section 6), and a bar of one or two cells across is stronger by 3
// %.
TEST(Cracking, BarsTakeTheFractureEnergy) {
  using enum material::Kinematics;
  for (const auto& [kinematics, d] : {std::pair{least_squares, 0.01},
                                      {least_squares, 0.005},
                                      {least_squares, 0.0025},
                                      {rotational, 0.01},
                                      {rotational, 0.005}}) {
    model::Definition definition = bar(d, kinematics);
    const double slow = d < 0.005 ? 1 : 3;
    definition.analysis.duration = slow * 7e-3;
    definition.boundaries[1].history = {
        {0, 0}, {slow * 5e-4, 0.01}, {slow * 2.5e-3, 0.09}, {slow * 4e-3, 0.25}, {slow * 7e-3, 1}};
    const Watched seen = watch(definition);
    const bool turns = kinematics == rotational;
    EXPECT_NEAR(seen.end.cracked / 1e-4 / 100, 1, 0.01) << d;
    EXPECT_NEAR(seen.peak / 1e-4 / 2.7e6, turns ? 1.03 : 1, turns ? 0.01 : 0.03 / slow) << d;
    EXPECT_LT(seen.unbalanced, 1e-5) << d;
    EXPECT_GT(seen.end.given, seen.end.cracked);
    EXPECT_EQ(seen.end.damped, 0);
    EXPECT_GT(seen.rows, 340);
  }
}

// Pulled until it cracks, pushed until it closes and held, with local damping: the closed crack carries the pressure of
// the intact bar, E A e, and energies add up. Exactly so with least-squares kinematics. Nodes with rotations of their
// own turn along the edges of crack faces, as along those of a smooth platen (theory, section 6): two cells across are
// softer by 8 %.
TEST(Cracking, ClosedCracksCarryPressure) {
  for (const auto kinematics : {material::Kinematics::rotational, material::Kinematics::least_squares}) {
    model::Definition definition = bar(0.005, kinematics);
    const bool fitted = kinematics == material::Kinematics::least_squares;
    definition.analysis.duration = 5e-3;
    definition.analysis.damping = {model::DampingDefinition::Kind::local, 0.3};
    definition.boundaries[1].history = {{0, 0}, {1e-3, 0.06}, {2e-3, 0.4}, {4e-3, -0.1}, {5e-3, -0.1}};
    const Watched seen = watch(definition);
    const double pressure = 30e9 * 1e-4 * 1e-5 / 0.08;
    EXPECT_NEAR(-seen.last / pressure, fitted ? 1 : 0.92, fitted ? 1e-5 : 0.01);
    EXPECT_NEAR(seen.end.leapfrog_energy / (0.5 * pressure * 1e-5), fitted ? 1 : 0.92, fitted ? 1e-5 : 0.01);
    EXPECT_GT(seen.end.cracked, 0.4 * 1e-4 * 100);
    EXPECT_LT(seen.end.cracked, 0.7 * 1e-4 * 100);
    EXPECT_GT(seen.end.damped, 0);
    EXPECT_LT(seen.unbalanced, 1e-5);
  }
}

TEST(Cracking, RowsThatAreFarFromTheirLimitsMissNothing) {
  // A plate that a pull from one face cracks, waves and all: as if every row was looked at in each step. One call of
  // step() each looks at all of them.
  model::Definition definition = test::block({24, 8, 6}, 0.01, concrete);
  definition.materials[0].fracture = fracture();
  definition.analysis.type = model::AnalysisDefinition::Type::dynamic;
  definition.analysis.duration = 1;
  definition.analysis.damping.kind = model::DampingDefinition::Kind::none;
  definition.boundaries = {test::fixed("held", model::Face::x_min, {0, 1, 2})};
  model::BoundaryDefinition pull;
  pull.name = "pull";
  pull.selection.face = model::Face::x_max;
  pull.velocity[0] = 1.5;
  pull.velocity[1] = 0.4;
  definition.boundaries.push_back(pull);
  driver::Simulation each(definition, Communicator::self()), few(definition, Communicator::self());
  constexpr int steps = 400;
  for (int s = 0; s < steps; ++s) each.step(1);
  few.step(steps);
  std::int64_t cracked = 0, intact = 0, equal = 0;
  lattice::for_each_owned(each.model().layout(), [&](auto, auto, auto, auto n) {
    const double damage = each.state().crack.component(0)[n];
    (damage > 0 ? cracked : intact) += 1;
    equal += few.state().crack.component(0)[n] == damage &&
             few.state().displacement.component(0)[n] == each.state().displacement.component(0)[n];
  });
  EXPECT_GT(cracked, 20);
  EXPECT_GT(intact, 500);
  EXPECT_EQ(equal, cracked + intact);
}

// A length of 0.9 mm for the nodes around a row of cells. What they move in common takes nothing off it; where one of
// them is faster by (0.3, 0, 0.4) m/s, 1 ms takes off half of 0.5 mm, so that the fourth spends it.
TEST(Cracking, MotionsInCommonSpendNothing) {
  const model::Model model = model::make_model(test::block({20, 3, 2}, 0.01, concrete), Communicator::self());
  model::State state(model);
  const lattice::Layout& layout = model.layout();
  lattice::for_each_owned(layout, [&](auto, auto, auto, auto n) {
    for (int c = 0; c < 3; ++c) state.velocity.component(c)[n] = 1000.0 * (c - 1) + 7;
  });
  failure::RowReach reach(model.lattice, state.velocity);
  const std::size_t row = failure::cell_row(layout, 1, 0), other = failure::cell_row(layout, 0, 0);
  std::vector<char> rows(failure::cell_row(layout, layout.owned()[1], layout.owned()[2]), 0);
  rows[row] = 1;
  reach.keep(rows);
  EXPECT_TRUE(reach.is_spent(row));
  EXPECT_FALSE(reach.is_spent(other)) << "it does not count";
  reach.set(row, 0.9e-3);
  reach.spend(1);
  EXPECT_FALSE(reach.is_spent(row));
  // Rows that were noted before are taken as they were then, for one step.
  for (std::int64_t k = 0; k < 2; ++k)
    for (std::int64_t j = 1; j < 3; ++j) reach.note(j, k);
  const std::int64_t node = layout.index(17, 2, 1);
  state.velocity.component(0)[node] += 0.3;
  state.velocity.component(2)[node] += 0.4;
  reach.spend(1);
  for (int step = 0; step < 4; ++step) {
    EXPECT_FALSE(reach.is_spent(row)) << step;
    reach.spend(1e-3);
  }
  EXPECT_TRUE(reach.is_spent(row));
  reach.set(row, 1);
  EXPECT_FALSE(reach.is_spent(row));
  reach.forget();
  EXPECT_TRUE(reach.is_spent(row));
}

// What damping takes, of free components of nodes that are held along others too: energies add up to rounding with
// either kind.
TEST(Cracking, DampingIsCountedOfWhatIsFree) {
  using Kind = model::DampingDefinition::Kind;
  for (const auto& [kind, factor, rate] : {std::tuple{Kind::local, 0.5, 0.0}, {Kind::viscous, 0.0, 2e4}}) {
    model::Definition definition = bar(0.01, material::Kinematics::rotational);
    definition.boundaries[1].history = {{0, 0}, {1e-4, 0.02}, {2e-4, 0.01}, {1e-3, 0.03}};
    definition.boundaries[1].displacement[1] = 1e-5;
    definition.analysis.duration = 1e-3;
    definition.analysis.damping = {kind, factor, rate};
    const Watched seen = watch(definition);
    EXPECT_EQ(seen.end.cracked, 0);
    EXPECT_GT(seen.end.damped, 0.03 * seen.end.given);
    EXPECT_LT(seen.end.damped, seen.end.given);
    EXPECT_LT(seen.unbalanced, 1e-9) << static_cast<int>(kind);
    EXPECT_GT(seen.rows, 40);
  }
}

}  // namespace
}  // namespace koshi
