// Conjugate gradients in single precision against those of PETSc in double.
#include "statics/mixed_gradients.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/exact_sum.h"
#include "mechanics/uniform_strain.h"
#include "support/periodic_block.h"

namespace koshi {
namespace {

// Two materials and voids, cell by cell without order; `soft`: Young's modulus of the second over that of the first.
model::Definition random_mixture(double soft) {
  const Int3 cells{12, 10, 14};
  model::Definition definition = test::periodic_block(cells);
  definition.materials = {{"a", {30e9, 0.2, 2600}}, {"b", {30e9 * soft, 0.3, 2000}}};
  std::uint32_t state = 1;
  test::fill(definition, cells, [&](const Int3&) {
    state = state * 1664525u + 1013904223u;
    const std::uint32_t drawn = (state >> 16) % 10;
    return drawn < 2 ? 0 : drawn < 5 ? 2 : 1;
  });
  return definition;
}

homogenize::Effective solved(const model::Definition& definition, homogenize::Boundary boundary, double tolerance,
                             bool by_petsc = false) {
  statics::StaticOptions options;
  options.tolerance = tolerance;
  if (by_petsc) options.petsc_options = {"-ksp_type", "cg"};
  model::Definition asked = definition;
  if (boundary != homogenize::Boundary::periodic) asked.body.periodic = {};
  const model::Model model = model::make_model(asked, Communicator::world());
  EXPECT_EQ(statics::MixedGradients::serves(model, options), !by_petsc);
  return homogenize::effective_stiffness(model, options, boundary);
}

TEST(MixedGradients, EndWhereDoublePrecisionDoes) {
  // Down to residuals of about 1e-10, thousands of roundings of single precision: C is the same to 1e-9, and rounding
  // costs at most two iterations on the way to a residual of 1e-8.
  const auto iterations = [](const statics::SolveReport& report) {
    const auto& history = report.residual_history;
    return std::ranges::find_if(history, [](double residual) { return residual < 1e-8; }) - history.begin();
  };
  int compared = 0;
  for (const double soft : {1e-1, 1e-3})
    for (const homogenize::Boundary boundary : {homogenize::Boundary::periodic, homogenize::Boundary::displacement}) {
      const model::Definition definition = random_mixture(soft);
      const homogenize::Effective mixed = solved(definition, boundary, 1e-20);
      const homogenize::Effective exact = solved(definition, boundary, 1e-11, true);
      for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_GT(iterations(exact.cases[i]), 7);
        EXPECT_NEAR(iterations(mixed.cases[i]), iterations(exact.cases[i]), 2);
        EXPECT_LE(mixed.cases[i].relative_residual, 1e-8);
        for (std::size_t j = 0; j < 6; ++j, ++compared)
          EXPECT_NEAR(mixed.stiffness.voigt[i][j] / exact.stiffness.voigt[0][0],
                      exact.stiffness.voigt[i][j] / exact.stiffness.voigt[0][0], 1e-9);
      }
    }
  EXPECT_EQ(compared, 4 * 36);
}

TEST(MixedGradients, TheErrorOfTheStiffnessIsTheTolerance) {
  // The energy of the error is the tolerance times that by which u lies below u = E x: in C, times Voigt's mean less C.
  // The estimate is good to an order of magnitude; what entries off the diagonal lack is at most the geometric mean.
  // Mean stresses alone would leave an error of first order, which the asymmetry shows.
  const model::Definition definition = random_mixture(0.1);
  const homogenize::Effective exact = solved(definition, homogenize::Boundary::periodic, 1e-12, true);
  const double voigt = exact.bounds.voigt.bulk + 4.0 / 3 * exact.bounds.voigt.shear;
  const double released = voigt - exact.stiffness.voigt[0][0];
  for (const double tolerance : {1e-5, 1e-8}) {
    const homogenize::Effective found = solved(definition, homogenize::Boundary::periodic, tolerance);
    double largest = 0;
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t j = 0; j < 6; ++j)
        largest = std::max(largest, std::abs(found.stiffness.voigt[i][j] - exact.stiffness.voigt[i][j]) / released);
    EXPECT_LT(largest, 10 * tolerance);
    EXPECT_GT(largest, 0.01 * tolerance);
    EXPECT_GT(found.asymmetry, 2 * tolerance);
    EXPECT_LT(found.asymmetry, std::sqrt(tolerance));
  }
}

TEST(MixedGradients, TheResidualIsThatOfTheDisplacements) {
  // What is reported against forces of the kernel in double precision; single precision rounds to 6e-8.
  const model::Model model = model::make_model(random_mixture(0.1), Communicator::world());
  statics::StaticOptions options;
  options.tolerance = 1e-9;
  statics::MixedGradients solver(model, options);
  lattice::Field<double> u(model.layout(), 6);
  const auto norm = [&] {
    mechanics::ForceKernel kernel(model.lattice);
    ExactSum square;
    kernel.for_each_row(u, [&](std::int64_t, std::int64_t, double* const* f) {
      for (int c = 0; c < 6; ++c)
        for (std::int64_t i = 0; i < model.layout().owned()[0]; ++i)
          square += std::pow(f[c][i] / (c < 3 ? 1 : 0.5 * model.lattice.grid.d), 2);
    });
    square.sum_ranks(model.communicator);
    return std::sqrt(square.value());
  };
  const mechanics::Tensor6 strain{0, 0, 1, 0.5, 0, 0};
  mechanics::add_uniform_strain(model, strain, u);
  const double before = norm();
  const statics::SolveReport report = solver.solve(strain, 0, u);
  EXPECT_LT(report.relative_residual, 1e-3);
  EXPECT_NEAR(norm() / before / report.relative_residual, 1, 1e-6);
}

TEST(MixedGradients, StrongContrastsAndOtherMethodsArePetscs) {
  const statics::StaticOptions options;
  const auto serves = [&](const model::Definition& definition) {
    return statics::MixedGradients::serves(model::make_model(definition, Communicator::world()), options);
  };
  EXPECT_TRUE(serves(random_mixture(2e-4)));
  EXPECT_FALSE(serves(random_mixture(1e-5)));
  // Edges alone leave rotations of nodes free, which the levels hold.
  model::Definition edges = random_mixture(0.1);
  edges.lattice.cell = lattice::CellType::cube_i;
  edges.lattice.calibration = material::Calibration::paper;
  edges.materials[1].elastic.poissons_ratio = 0.2;
  EXPECT_FALSE(serves(edges));
}

}  // namespace
}  // namespace koshi
