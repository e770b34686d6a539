// Iterations of the static solver to a residual of 1e-8, and bodies that are not held everywhere. The limits are those
// the solver is promised to keep at every size (docs/theory/10_equilibrium.md); the counts here are of small bodies.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "koshi/statics.h"
#include "support/cantilever.h"
#include "support/cases.h"

namespace koshi {
namespace {

using lattice::CellType;
using material::Kinematics;
using material::Sharing;

statics::SolveReport solve(const model::Definition& definition) {
  const model::Model model = model::make_model(definition, Communicator::world());
  model::State state(model);
  return statics::solve_static(model, state, {});
}

void expect_iterations(const model::Definition& definition, int most) {
  const statics::SolveReport report = solve(definition);
  EXPECT_TRUE(report.converged);
  EXPECT_LE(report.relative_residual, 1e-8);
  EXPECT_LE(report.iterations, most);
  EXPECT_EQ(report.residual_history.size(), static_cast<std::size_t>(report.iterations) + 1);
  EXPECT_EQ(report.residual_history.front(), 1);
  // The body was large enough to need the coarser levels.
  EXPECT_GE(report.levels, 2);
  EXPECT_GT(report.unknowns, 20000);
}

model::Definition beam(CellType cell, Sharing sharing, Kinematics kinematics, double nu, double spacing = 0.001) {
  model::Definition definition = test::cantilever(spacing, nu);
  definition.lattice.cell = cell;
  definition.lattice.springs = sharing;
  definition.lattice.kinematics = kinematics;
  return definition;
}

TEST(Iterations, Cantilever) {
  constexpr auto iii = CellType::cube_iii;
  constexpr auto rotational = Kinematics::rotational, fit = Kinematics::least_squares;
  expect_iterations(beam(iii, Sharing::shared, rotational, 0.18), 12);
  expect_iterations(beam(iii, Sharing::shared, rotational, 0.18, 0.002), 12);
  expect_iterations(beam(iii, Sharing::shared, fit, 0.18), 12);
  expect_iterations(beam(CellType::cube_ii, Sharing::shared, rotational, 0.18), 12);
  expect_iterations(beam(CellType::cube_ii, Sharing::plain, rotational, 0.18), 25);
  expect_iterations(beam(CellType::cube_i, Sharing::shared, fit, 0.18), 25);
}

// A plate of two cells, clamped along its edges and pressed on from above.
TEST(Iterations, ThinPlate) {
  model::Definition definition = test::block({60, 60, 2}, 0.001, {25e9, 0.3, 2000});
  definition.analysis = {};
  definition.boundaries.clear();
  for (const model::Face face : {model::Face::x_min, model::Face::x_max, model::Face::y_min, model::Face::y_max})
    definition.boundaries.push_back(
        test::fixed("edge " + std::to_string(static_cast<int>(face)), face, {0, 1, 2, 3, 4, 5}));
  model::LoadDefinition wind;
  wind.name = "wind";
  wind.selection.face = model::Face::z_max;
  wind.pressure = 1e3;
  definition.loads = {wind};
  expect_iterations(definition, 25);
}

TEST(Iterations, NearlyIncompressible) {
  const auto nearly = [](double nu) { return beam(CellType::cube_iii, Sharing::shared, Kinematics::rotational, nu); };
  expect_iterations(nearly(0.45), 20);
  expect_iterations(nearly(0.49), 30);
  expect_iterations(nearly(0.499), 90);
}

// A block of n cells pressed from above; `material` names the cells.
template <class F>
model::Definition block(const Int3& n, F&& material) {
  constexpr double d = 0.001;
  model::Definition definition;
  definition.lattice.spacing = d;
  definition.body.size = {d * static_cast<double>(n[0]), d * static_cast<double>(n[1]), d * static_cast<double>(n[2])};
  definition.materials = {{"hard", {25e9, 0.2, 2000}}, {"soft", {2.5e9, 0.2, 2000}}};
  for (std::int64_t k = 0; k < n[2]; ++k)
    for (std::int64_t j = 0; j < n[1]; ++j)
      for (std::int64_t i = 0; i < n[0]; ++i) definition.body.cells.push_back(material(Int3{i, j, k}));
  model::BoundaryDefinition bottom, top;
  bottom.name = "bottom";
  bottom.selection.face = model::Face::z_min;
  bottom.fix.fill(true);
  top.name = "top";
  top.selection.face = model::Face::z_max;
  top.fix = {true, true, false, true, true, true};
  top.displacement[2] = -1e-5;
  definition.boundaries = {bottom, top};
  return definition;
}

// Overlapping spherical voids, 30 % of the body; odd numbers of cells.
TEST(Iterations, PorousBlock) {
  const Int3 n{33, 29, 47};
  std::vector<std::uint16_t> cells(static_cast<std::size_t>(n[0] * n[1] * n[2]), 1);
  std::mt19937 random(1);
  const auto uniform = [&](double scale) { return scale * static_cast<double>(random()) / 4294967296.0; };
  std::size_t empty = 0;
  while (10 * empty < 3 * cells.size()) {
    const Vec3 centre{uniform(33), uniform(29), uniform(47)};
    const double radius = 2.5 + uniform(3);
    std::size_t at = 0;
    for (std::int64_t k = 0; k < n[2]; ++k)
      for (std::int64_t j = 0; j < n[1]; ++j)
        for (std::int64_t i = 0; i < n[0]; ++i, ++at) {
          const double x = static_cast<double>(i) + 0.5 - centre[0], y = static_cast<double>(j) + 0.5 - centre[1],
                       z = static_cast<double>(k) + 0.5 - centre[2];
          if (k == 0 || k == n[2] - 1 || cells[at] == 0 || x * x + y * y + z * z > radius * radius) continue;
          cells[at] = 0;
          ++empty;
        }
  }
  std::size_t at = 0;
  expect_iterations(block(n, [&](const Int3&) { return cells[at++]; }), 25);
}

// Every third cell or so ten times softer, and periodic across.
TEST(Iterations, TwoPhaseBlock) {
  std::mt19937 random(2);
  const auto mixed = [&](const Int3&) { return static_cast<std::uint16_t>(random() % 10 < 3 ? 2 : 1); };
  expect_iterations(block({29, 27, 37}, mixed), 25);
  model::Definition periodic = block({28, 24, 36}, mixed);
  periodic.body.periodic = {true, true, false};
  expect_iterations(periodic, 25);
  // Odd periods are halved too: 29 = 14.5 x 2, 45 = 22.5 x 2.
  periodic = block({29, 45, 27}, mixed);
  periodic.body.periodic = {true, true, false};
  expect_iterations(periodic, 25);
}

// A cube of 3^3 cells that floats in a hole: six motions that nothing holds, found and left out while nothing pushes
// it.
model::Definition island() {
  return block({21, 21, 31}, [](const Int3& c) {
    int outside = 0;  // of the hole of 5^3 cells, of the cube inside it
    for (int a = 0; a < 3; ++a) {
      const std::int64_t distance = std::abs(c[a] - 10);
      outside = std::max(outside, distance > 2 ? 2 : distance > 1 ? 1 : 0);
    }
    return static_cast<std::uint16_t>(outside == 1 ? 0 : 1);
  });
}

TEST(FreeMotions, AnIslandIsFoundAndLeftOut) {
  const statics::SolveReport report = solve(island());
  EXPECT_LE(report.relative_residual, 1e-8);
  EXPECT_LE(report.iterations, 25);
  EXPECT_EQ(report.projected_motions, 6);
  EXPECT_EQ(report.free_motions,
            "part 2 of 2 (27 cells, x 0.009 to 0.012 m, y 0.009 to 0.012 m, z 0.009 to 0.012 m) is free to move along "
            "x, y, z and rotate about x, y, z");
}

TEST(FreeMotions, APushedIslandIsRefusedByName) {
  model::Definition definition = island();
  model::LoadDefinition weight;
  weight.acceleration = Vec3{0, 0, -9.81};
  definition.loads = {weight};
  try {
    solve(definition);
    FAIL() << "no equilibrium exists";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("part 2 of 2 (27 cells"));
    EXPECT_THAT(error.what(), testing::HasSubstr("its loads do not balance"));
  }
}

// On a smooth platen a block may slide and turn: balanced loads leave it where it is, a push is refused.
TEST(FreeMotions, ABlockOnASmoothPlatenMaySlide) {
  model::Definition definition = block({20, 20, 20}, [](const Int3&) { return std::uint16_t{1}; });
  definition.lattice.kinematics = Kinematics::least_squares;  // exact without a hold on rotations
  definition.boundaries[0].fix = {false, false, true, false, false, false};
  definition.boundaries.pop_back();
  model::LoadDefinition pressure;
  pressure.name = "pressure";
  pressure.selection.face = model::Face::z_max;
  pressure.pressure = 1e6;
  definition.loads = {pressure};
  const model::Model model = model::make_model(definition, Communicator::world());
  model::State state(model);
  const statics::SolveReport report = statics::solve_static(model, state, {});
  EXPECT_EQ(report.projected_motions, 3);
  EXPECT_EQ(report.free_motions.substr(report.free_motions.find("is free")),
            "is free to move along x, y and rotate about z");
  // Uniform compression: u_z = -p h/E on top; no mean motion along x and y.
  const lattice::Field<double>& u = state.displacement;
  EXPECT_NEAR(u.component(2)[model.layout().index(7, 3, 20)] / (-1e6 * 0.02 / 25e9), 1, 1e-6);
  std::array<double, 2> mean{};
  lattice::for_each_owned(model.layout(), [&](auto, auto, auto, auto n) {
    for (std::size_t c = 0; c < 2; ++c) mean[c] += u.component(static_cast<int>(c))[n] / 9261;
  });
  for (const double m : mean) EXPECT_NEAR(m, 0, 1e-14);

  definition.loads[0].pressure.reset();
  definition.loads[0].force = Vec3{1, 0, 0};
  EXPECT_THROW(solve(definition), InputError);
}

TEST(Statics, SaysWhatDidNotConvergeAndLeavesTheVelocitiesZero) {
  const model::Model model = model::make_model(test::cantilever(0.002, 0.18), Communicator::world());
  model::State state(model);
  statics::StaticOptions options;
  options.petsc_options = {"-ksp_max_it", "2", "-ksp_maxit", "9"};
  try {
    statics::solve_static(model, state, options);
    FAIL() << "two iterations are not enough";
  } catch (const RunError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("found in 2 iterations: more of them are needed; relative residual by "
                                                 "iteration: 0: 1.0e+00, 1: "));
    EXPECT_THAT(error.what(), testing::HasSubstr("allow more iterations (-- -ksp_max_it 2000)"));
    EXPECT_THAT(error.what(), testing::HasSubstr("not used: -ksp_maxit"));
  }
  for (std::size_t i = 0; i < state.velocity.count(); ++i) ASSERT_EQ(state.velocity.data()[i], 0);
  EXPECT_GT(state.velocity.count(), 24000u);

  // The options reach PETSc: another method, the same answer.
  options.petsc_options = {"-ksp_type", "fcg", "-ksp_rtol", "1e-10", "-gone", "1"};
  const auto report = statics::solve_static(model, state, options);
  EXPECT_LE(report.relative_residual, 1e-10);
  EXPECT_EQ(report.unused_options, std::vector<std::string>{"-gone"});
}

}  // namespace
}  // namespace koshi
