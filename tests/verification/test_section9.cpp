// The cantilever's numbers of theory.md, section 9, to their printed digits [cm].
#include <gtest/gtest.h>

#include <string>

#include "support/cases.h"
#include "support/equilibrium.h"

namespace koshi {
namespace {

using lattice::CellType;
using material::Calibration;
using material::Kinematics;
using model::Face;
constexpr auto rotational = Kinematics::rotational;
constexpr auto fitted = Kinematics::least_squares;
constexpr auto cube_ii = CellType::cube_ii;
constexpr auto cube_iii = CellType::cube_iii;

struct Row {
  CellType cell;
  Calibration calibration;
  Kinematics kinematics;
  double nu;
  double mean;    ///< area mean over the end face [cm]
  double centre;  ///< of the end face [cm]; 0: not given
};

constexpr auto isotropic = Calibration::isotropic;
constexpr auto exact = Calibration::bending_exact;

const Row rows[] = {
    {cube_ii, isotropic, rotational, 0.18, 0.016233, 0},     {cube_iii, isotropic, rotational, 0.18, 0.016235, 0},
    {cube_ii, isotropic, fitted, 0.18, 0.016105, 0},         {cube_iii, exact, rotational, 0.18, 0.016424, 0.016415},
    {cube_iii, exact, fitted, 0.18, 0.016428, 0.016421},     {cube_iii, exact, rotational, 0.00, 0.016446, 0.016436},
    {cube_iii, exact, rotational, 0.30, 0.016288, 0.016280}, {cube_iii, exact, fitted, 0.30, 0.016305, 0.016299},
    {cube_iii, exact, rotational, 0.45, 0.015915, 0.015910}, {cube_iii, exact, rotational, 0.49, 0.015768, 0},
    {cube_iii, exact, rotational, -0.30, 0.016021, 0},       {cube_ii, isotropic, rotational, 0.45, 0.015792, 0},
    {cube_ii, isotropic, fitted, 0.45, 0.015731, 0},         {cube_ii, isotropic, rotational, -0.30, 0.015886, 0},
};

// A clamped beam along y, loaded in x over its end: mean and, for odd cell numbers, centre deflection of the end [m].
std::array<double, 2> tip(const Row& row, const Int3& cells, double d, material::Sharing sharing) {
  model::Definition definition = test::block(cells, d, {1112e6, row.nu, 2000});
  definition.lattice.cell = row.cell;
  definition.lattice.calibration = row.calibration;
  definition.lattice.kinematics = row.kinematics;
  definition.lattice.springs = sharing;
  if (row.calibration == Calibration::paper) definition.lattice.axes = "yxz";
  definition.analysis.type = model::AnalysisDefinition::Type::statics;
  definition.boundaries = {test::fixed("root", Face::y_min, {0, 1, 2, 3, 4, 5})};
  model::LoadDefinition load;
  load.selection.face = Face::y_max;
  load.force = Vec3{9.8, 0, 0};
  definition.loads = {load};
  definition.probes = {test::probe("tip", Face::y_max, model::ProbeDefinition::Quantity::displacement,
                                   model::ProbeDefinition::Reduce::area_mean)};
  // The deflection is an energy (force times mean displacement), so its error is the square of the residual's.
  test::Equilibrium solved(definition, 1e-6);
  double centre = 0;
  const std::int64_t low = cells[0] / 2;
  for (const std::int64_t i : {low, low + 1})
    for (const std::int64_t k : {low, low + 1}) centre += 0.25 * solved.u(0, i, cells[1], k);
  return {solved.probe(0)[0], centre};
}

// The paper's cantilever [cm].
std::array<double, 2> cantilever(const Row& row, material::Sharing sharing, int refined = 1) {
  const auto [mean, centre] = tip(row, {9 * refined, 39 * refined, 9 * refined}, 0.002 / refined, sharing);
  return {100 * mean, 100 * centre};
}

class Section9 : public testing::TestWithParam<Row> {};

TEST_P(Section9, CantileverToThePrintedDigits) {
  const Row& row = GetParam();
  const auto [mean, centre] = cantilever(row, material::Sharing::shared);
  EXPECT_NEAR(mean, row.mean, 0.51e-6);
  if (row.centre != 0) EXPECT_NEAR(centre, row.centre, 0.51e-6);
}

INSTANTIATE_TEST_SUITE_P(All, Section9, testing::ValuesIn(rows), [](const auto& info) {
  const Row& row = info.param;
  return std::string(row.cell == cube_ii ? "II" : "III") + (row.calibration == exact ? "_exact" : "_isotropic") +
         (row.kinematics == rotational ? "_rotational" : "_fitted") + (row.nu < 0 ? "_minus" : "_") +
         std::to_string(static_cast<int>(std::lround(100 * std::abs(row.nu))));
});

TEST(Section9, PlainSpringsOfThePaper) {
  EXPECT_NEAR(cantilever({cube_ii, Calibration::paper, rotational, 0.18, 0, 0}, material::Sharing::plain)[0], 0.01403,
              0.51e-5);
}

TEST(Section9, HalfTheSpacing) {
  const struct {
    Row row;
    double mean;
  } halved[] = {{{cube_ii, isotropic, rotational, 0.18, 0, 0}, 0.016389},
                {{cube_ii, isotropic, fitted, 0.18, 0, 0}, 0.016357},
                {{cube_iii, exact, rotational, 0.00, 0, 0}, 0.016446},
                {{cube_iii, exact, rotational, 0.30, 0, 0}, 0.016321},
                {{cube_iii, exact, rotational, 0.45, 0, 0}, 0.016009}};
  for (const auto& [row, mean] : halved)
    EXPECT_NEAR(cantilever(row, material::Sharing::shared, 2)[0], mean, 0.51e-6) << row.nu;
}

// Converged three-dimensional elasticity (theory.md, section 9): within 0.2 % at nu = 0 and 0.18, 0.4 % at 0.3. At 0.45
// the clamped root leaves -1.06 % with node rotations, -0.74 % with the fit.
TEST(Section9, MeetsConvergedElasticity) {
  const struct {
    double nu, converged, bound_rotational, bound_fitted;
  } cases[] = {{0.00, 0.0164469, 0.002, 0.002},
               {0.18, 0.0164472, 0.002, 0.002},
               {0.30, 0.0163479, 0.004, 0.004},
               {0.45, 0.0160858, 0.0107, 0.0075}};
  for (const auto& c : cases) {
    const double full = cantilever({cube_iii, exact, rotational, c.nu, 0, 0}, material::Sharing::shared)[0];
    const double fit = cantilever({cube_iii, exact, fitted, c.nu, 0, 0}, material::Sharing::shared)[0];
    EXPECT_NEAR(full / c.converged, 1, c.bound_rotational) << c.nu;
    EXPECT_NEAR(fit / c.converged, 1, c.bound_fitted) << c.nu;
  }
}

// Beam-exact springs at nu = 0.45: within 1 % of converged elasticity, and slender beams nearer than the bending-exact
// ones (by a sparse direct solution of the same cells in double precision: -0.997 %, beams 0.9857, 0.9772, 0.9749).
TEST(Section9, BeamExactSprings) {
  const Row row{cube_iii, Calibration::beam_exact, rotational, 0.45, 0, 0};
  EXPECT_NEAR(cantilever(row, material::Sharing::shared)[0] / 0.0160858 - 1, -0.00997, 1e-5);
  const double width = 0.01, k = 10 * 1.45 / (12 + 11 * 0.45), mu = 1112e6 / 2.9;
  const double timoshenko = 9.8 * 1e-3 / (3 * 1112e6 * std::pow(width, 4) / 12) + 9.8 * 0.1 / (k * mu * width * width);
  const std::array<double, 3> ratio{0.98573, 0.97717, 0.97492};
  for (std::size_t s = 0; s < 3; ++s) {
    const std::int64_t n = 1 << s;
    const double u = tip(row, {n, 10 * n, n}, width / static_cast<double>(n), material::Sharing::shared)[0];
    EXPECT_NEAR(u / timoshenko, ratio[s], 1e-4) << n;
  }
}

// Beams ten times as long as wide, n = 1, 2, 4 cells across, over Timoshenko's P L^3 / 3 E I + P L / (k G A) with
// Cowper's k = 10 (1 + nu) / (12 + 11 nu) (DOI 10.1115/1.3625046).
TEST(Section9, SlenderBeams) {
  const struct {
    Row row;
    std::array<double, 3> ratio;
    double digit;
  } beams[] = {{{cube_iii, exact, rotational, 0.00, 0, 0}, {0.9967, 1.0002, 1.0000}, 1e-4},
               {{cube_iii, exact, rotational, 0.18, 0, 0}, {0.992, 0.996, 0.996}, 1e-3},
               {{cube_iii, exact, rotational, 0.30, 0, 0}, {0.985, 0.995, 0.990}, 1e-3},
               {{cube_iii, exact, rotational, 0.45, 0, 0}, {0.970, 0.970, 0.974}, 1e-3},
               {{cube_iii, isotropic, rotational, 0.00, 0, 0}, {0.62, 0.87, 0.96}, 1e-2},
               {{cube_ii, isotropic, rotational, 0.45, 0, 0}, {0.64, 0.85, 0.94}, 1e-2}};
  const double width = 0.01, length = 0.1, P = 9.8, E = 1112e6;
  for (const auto& [row, ratio, digit] : beams) {
    const double k = 10 * (1 + row.nu) / (12 + 11 * row.nu);
    const double timoshenko = P * std::pow(length, 3) / (3 * E * std::pow(width, 4) / 12) +
                              P * length / (k * E / (2 * (1 + row.nu)) * width * width);
    for (std::size_t s = 0; s < 3; ++s) {
      const std::int64_t n = 1 << s;
      const double u = tip(row, {n, 10 * n, n}, width / static_cast<double>(n), material::Sharing::shared)[0];
      EXPECT_NEAR(u / timoshenko, ratio[s], 0.51 * digit) << "nu " << row.nu << ", n " << n;
    }
  }
}

}  // namespace
}  // namespace koshi
