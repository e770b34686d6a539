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

homogenize::Effective solved(const model::Definition& definition, homogenize::Boundary boundary, bool by_petsc) {
  statics::StaticOptions options;
  options.tolerance = 1e-11;
  if (by_petsc) options.petsc_options = {"-ksp_type", "cg"};
  model::Definition asked = definition;
  if (boundary != homogenize::Boundary::periodic) asked.body.periodic = {};
  const model::Model model = model::make_model(asked, Communicator::world());
  EXPECT_EQ(statics::MixedGradients::serves(model, options), !by_petsc);
  return homogenize::effective_stiffness(model, options, boundary);
}

TEST(MixedGradients, EndWhereDoublePrecisionDoes) {
  // To a residual of 1e-11 in double precision, thousands of roundings of single precision: C is the same to 1e-9, and
  // rounding costs at most two iterations.
  int compared = 0;
  for (const double soft : {1e-1, 1e-3})
    for (const homogenize::Boundary boundary : {homogenize::Boundary::periodic, homogenize::Boundary::displacement}) {
      const model::Definition definition = random_mixture(soft);
      const homogenize::Effective mixed = solved(definition, boundary, false),
                                  exact = solved(definition, boundary, true);
      for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_GT(exact.cases[i].iterations, 10);
        EXPECT_NEAR(mixed.cases[i].iterations, exact.cases[i].iterations, 2);
        EXPECT_LE(mixed.cases[i].relative_residual, 1e-11);
        for (std::size_t j = 0; j < 6; ++j, ++compared)
          EXPECT_NEAR(mixed.stiffness.voigt[i][j] / exact.stiffness.voigt[0][0],
                      exact.stiffness.voigt[i][j] / exact.stiffness.voigt[0][0], 1e-9);
      }
    }
  EXPECT_EQ(compared, 4 * 36);
}

TEST(MixedGradients, TheResidualIsThatOfTheDisplacements) {
  // What is reported against forces of the kernel in double precision.
  const model::Model model = model::make_model(random_mixture(0.1), Communicator::world());
  statics::StaticOptions options;
  options.tolerance = 1e-9;
  statics::MixedGradients solver(model, options);
  lattice::Field<double> u(model.layout(), 6), force(model.layout(), 6);
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
  EXPECT_LE(report.relative_residual, 1e-9);
  // To 1e-15 of forces of 12 cells and the rounding of single precision.
  EXPECT_NEAR(norm() / before, report.relative_residual, 1e-12);
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
