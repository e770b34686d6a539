// The paper's cantilever by direct equilibrium: theory.md, section 9, and how many iterations it takes.
#include <gtest/gtest.h>

#include "koshi/statics.h"
#include "mechanics/measure.h"
#include "support/cantilever.h"

namespace koshi {
namespace {

using lattice::CellType;
using material::Calibration;
using material::Kinematics;
using material::Sharing;

struct Row {
  CellType cell;
  Sharing sharing;
  Calibration calibration;
  Kinematics kinematics;
  double nu;
  double spacing;     ///< [m]
  double deflection;  ///< mean over the end face [cm], as printed
  double last_digit;  ///< half a unit of it
};

constexpr auto shared = Sharing::shared;
constexpr auto isotropic = Calibration::isotropic, exact = Calibration::bending_exact;
constexpr auto rotational = Kinematics::rotational, least_squares = Kinematics::least_squares;

class Section9 : public testing::TestWithParam<Row> {};

TEST_P(Section9, DeflectionIsTheTables) {
  const Row& row = GetParam();
  model::Definition definition = test::cantilever(row.spacing, row.nu);
  definition.lattice.cell = row.cell;
  definition.lattice.springs = row.sharing;
  definition.lattice.calibration = row.calibration;
  definition.lattice.kinematics = row.kinematics;
  if (row.calibration == Calibration::paper) definition.lattice.axes = "yxz";
  const model::Model model = model::make_model(definition, Communicator::world());
  model::State state(model);
  statics::StaticOptions options;
  options.tolerance = 1e-10;
  const auto report = statics::solve_static(model, state, options);
  EXPECT_LE(report.relative_residual, 1e-10);
  mechanics::ForceKernel kernel(model.lattice);
  const auto measured = mechanics::Meter(model, kernel).measure(state, 0);
  ASSERT_EQ(measured.probes.size(), 1u);
  EXPECT_NEAR(100 * measured.probes[0][0], row.deflection, row.last_digit * (1 + 1e-6));
  // The beam bends in its plane of symmetry.
  EXPECT_NEAR(measured.probes[0][2], 0, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(
    Cantilever, Section9,
    testing::Values(Row{CellType::cube_ii, Sharing::plain, Calibration::paper, rotational, 0.18, 0.002, 0.01403, 5e-6},
                    Row{CellType::cube_ii, shared, isotropic, rotational, 0.18, 0.002, 0.016233, 5e-7},
                    Row{CellType::cube_ii, shared, isotropic, rotational, 0.18, 0.001, 0.016389, 5e-7},
                    Row{CellType::cube_iii, shared, isotropic, rotational, 0.18, 0.002, 0.016235, 5e-7},
                    Row{CellType::cube_ii, shared, isotropic, least_squares, 0.18, 0.002, 0.016105, 5e-7},
                    Row{CellType::cube_ii, shared, isotropic, least_squares, 0.18, 0.001, 0.016357, 5e-7},
                    Row{CellType::cube_iii, shared, exact, rotational, 0.18, 0.002, 0.016424, 5e-7},
                    Row{CellType::cube_iii, shared, exact, least_squares, 0.18, 0.002, 0.016428, 5e-7},
                    Row{CellType::cube_iii, shared, exact, rotational, 0.00, 0.002, 0.016446, 5e-7},
                    Row{CellType::cube_iii, shared, exact, rotational, 0.00, 0.001, 0.016446, 5e-7},
                    Row{CellType::cube_iii, shared, exact, rotational, 0.30, 0.002, 0.016288, 5e-7},
                    Row{CellType::cube_iii, shared, exact, least_squares, 0.30, 0.002, 0.016305, 5e-7},
                    Row{CellType::cube_iii, shared, exact, rotational, 0.30, 0.001, 0.016321, 5e-7},
                    Row{CellType::cube_iii, shared, exact, rotational, 0.45, 0.002, 0.015915, 5e-7},
                    Row{CellType::cube_iii, shared, exact, rotational, 0.45, 0.001, 0.016009, 5e-7},
                    Row{CellType::cube_iii, shared, exact, rotational, 0.49, 0.002, 0.015768, 5e-7},
                    Row{CellType::cube_iii, shared, exact, rotational, -0.30, 0.002, 0.016021, 5e-7},
                    Row{CellType::cube_ii, shared, isotropic, rotational, 0.45, 0.002, 0.015792, 5e-7},
                    Row{CellType::cube_ii, shared, isotropic, least_squares, 0.45, 0.002, 0.015731, 5e-7},
                    Row{CellType::cube_ii, shared, isotropic, rotational, -0.30, 0.002, 0.015886, 5e-7}));

}  // namespace
}  // namespace koshi
