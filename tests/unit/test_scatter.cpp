// What differs from cell to cell: random numbers, their distributions, files, grain boundaries.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "koshi/input.h"
#include "koshi/model.h"
#include "model/noise.h"
#include "model/scatter.h"

namespace koshi::model {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

// Mean of f over pairs of values of a box n^3 whose cells are r apart along an axis.
double mean_product(const std::vector<double>& values, std::int64_t n, std::size_t axis, std::int64_t r) {
  double sum = 0;
  std::int64_t pairs = 0;
  const std::array<std::int64_t, 3> step{1, n, n * n};
  for (std::int64_t k = 0; k < n; ++k)
    for (std::int64_t j = 0; j < n; ++j)
      for (std::int64_t i = 0; i < n; ++i) {
        if (Int3{i, j, k}[axis] + r >= n) continue;
        const std::int64_t at = i + n * (j + n * k);
        sum += values[static_cast<std::size_t>(at)] * values[static_cast<std::size_t>(at + r * step[axis])];
        ++pairs;
      }
  return sum / static_cast<double>(pairs);
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

lattice::Grid grid(std::int64_t n) { return {{n, n, n}, 1, {}, {}}; }

// 64 000 numbers: their mean has the standard deviation 1/sqrt(n) = 0.004, products of neighbours too, and squares 1.4
// times that. Allowed are four of them.
TEST(Noise, IsStandardNormalAndUncorrelated) {
  const auto one = gaussian_numbers(grid(40), {0, 0, 0}, {40, 40, 40}, 0, 1);
  ASSERT_EQ(one.size(), 64000u);
  EXPECT_NEAR(mean(one), 0, 0.016);
  EXPECT_NEAR(mean_product(one, 40, 0, 0), 1, 0.022);
  for (const std::size_t axis : {0u, 1u, 2u}) EXPECT_NEAR(mean_product(one, 40, axis, 1), 0, 0.016);
  // Of the normal distribution 0.13 % lie beyond three standard deviations on each side: 86 +- 4 sqrt(86) of 64 000.
  EXPECT_NEAR(std::ranges::count_if(one, [](double g) { return g > 3; }), 86, 37);
  // Another seed gives other numbers.
  const auto other = gaussian_numbers(grid(40), {0, 0, 0}, {40, 40, 40}, 0, 2);
  double product = 0;
  for (std::size_t n = 0; n < one.size(); ++n) product += one[n] * other[n] / 64000;
  EXPECT_NEAR(product, 0, 0.016);
}

// Numbers within (sqrt(pi) l)^3 = 150 cells are about the same for l = 3: 216 000 of them are worth 1440, and a mean
// has the standard deviation 0.026; one of squares 0.022.
TEST(Noise, IsCorrelatedAsAsked) {
  const auto numbers = gaussian_numbers(grid(60), {0, 0, 0}, {60, 60, 60}, 3, 5);
  EXPECT_NEAR(mean(numbers), 0, 0.1);
  const double variance = mean_product(numbers, 60, 0, 0);
  EXPECT_NEAR(variance, 1, 0.09);
  for (const std::size_t axis : {0u, 1u, 2u})
    for (const int r : {1, 2, 3, 4})
      EXPECT_NEAR(mean_product(numbers, 60, axis, r) / variance, std::exp(-r * r / 9.0), 0.05) << r;
}

// Any box has the same bits, also one that lies across the border of a periodic body.
TEST(Noise, DoesNotDependOnTheBox) {
  lattice::Grid periodic = grid(12);
  periodic.periodic = {true, true, true};
  for (const lattice::Grid& body : {grid(12), periodic}) {
    const auto whole = gaussian_numbers(body, {0, 0, 0}, {12, 12, 12}, 2.5, 3);
    const Int3 lo{3, -1, 5}, hi{13, 7, 12};
    const auto part = gaussian_numbers(body, lo, hi, 2.5, 3);
    std::size_t at = 0, compared = 0;
    for (std::int64_t k = lo[2]; k < hi[2]; ++k)
      for (std::int64_t j = lo[1]; j < hi[1]; ++j)
        for (std::int64_t i = lo[0]; i < hi[0]; ++i, ++at) {
          const bool outside = i >= 12 || j < 0;
          if (outside && !body.periodic[0]) continue;
          EXPECT_EQ(part[at], whole[static_cast<std::size_t>(i % 12 + 12 * ((j + 12) % 12 + 12 * k))]);
          ++compared;
        }
    EXPECT_EQ(compared, body.periodic[0] ? 560u : 9u * 7 * 7);
  }
}

// Weibull: of all cells the part exp(-(f/f_0)^m) is stronger than f, f_0 = 1/Gamma(1 + 1/m); the median is f_0 (ln
// 2)^(1/m). One standard deviation above, 15.8655 % are stronger. The mean over many cells is 1, the variation
// sqrt(Gamma(1 + 2/m)/Gamma(1 + 1/m)^2 - 1).
TEST(Scatter, HasTheDistributionAskedFor) {
  const material::Scatter weibull{.modulus = 8};
  const double f_0 = 1 / std::tgamma(1 + 1 / 8.0);
  EXPECT_NEAR(scattered(weibull, 0), f_0 * std::pow(std::log(2), 1 / 8.0), 1e-12);
  EXPECT_NEAR(scattered(weibull, 1), f_0 * std::pow(-std::log(0.158655253931457), 1 / 8.0), 1e-12);
  const material::Scatter normal{.distribution = material::Distribution::normal, .variation = 0.2};
  EXPECT_EQ(scattered(normal, 0.5), 1.1);
  EXPECT_EQ(scattered(normal, -7), scattered(normal, -3));
  EXPECT_NEAR(scattered(normal, -3), 0.4, 1e-15);

  double sum = 0, squares = 0;
  for (const double number : gaussian_numbers(grid(40), {0, 0, 0}, {40, 40, 40}, 0, 9)) {
    const double f = scattered(weibull, number);
    EXPECT_GT(f, 0);
    sum += f / 64000;
    squares += f * f / 64000;
  }
  // 0.148 sqrt(1/64000) = 0.0006 is the standard deviation of the mean.
  EXPECT_NEAR(sum, 1, 0.0024);
  const double variation = std::sqrt(std::tgamma(1 + 2 / 8.0) * f_0 * f_0 - 1);
  EXPECT_NEAR(std::sqrt(squares - sum * sum) / variation, 1, 0.02);
}

const std::string block = R"([lattice]
spacing = "1 mm"
[body]
size = ["6 mm", "2 mm", "2 mm"]
material = "rock"
[material.rock]
youngs_modulus = 1e9
poissons_ratio = 0.2
density = 1000
fracture = { tensile_strength = 1e6, fracture_energy = 100, strength_scatter = { modulus = 6, seed = 3 } }
stiffness_scatter = { distribution = "normal", variation = 0.1, seed = 4 }
[material.clay]
youngs_modulus = 1e8
poissons_ratio = 0.2
density = 1000
[[region]]
shape = "box"
min = ["4 mm", 0, 0]
max = ["6 mm", "2 mm", "2 mm"]
material = "clay"
[analysis]
type = "dynamic"
duration = 1
)";

Definition read(const std::vector<std::string>& overrides = {}) {
  return io::read_case_text(block, "case.toml", overrides);
}

// Each material has its own scatter or none, and each scatter its seed; what the file or a program gives comes on top.
TEST(Scatter, GoesToTheCellsOfItsMaterial) {
  Definition definition = read();
  definition.body.strengths.assign(24, 2.0F);
  definition.body.factors.assign(24, 0.5F);
  const Model model = make_model(definition, Communicator::world());
  int rock = 0, clay = 0;
  lattice::for_each_owned(model.layout(), [&](auto i, auto j, auto k, auto n) {
    if (model.lattice.cell.component(0)[n] == 0) return;
    const bool soft = i >= 4;
    const Definition& d = definition;
    const double strength = scattered(*d.materials[0].fracture->strength_scatter, normal_number({i, j, k}, 3));
    const double stiffness = scattered(*d.materials[0].stiffness_scatter, normal_number({i, j, k}, 4));
    EXPECT_NEAR(model.strength_of(n), 2 * (soft ? 1 : strength), 1e-6);
    EXPECT_NEAR(model.lattice.factor_of(n), 0.5 * (soft ? 1 : stiffness), 1e-6);
    ++(soft ? clay : rock);
  });
  EXPECT_EQ(rock, 16);
  EXPECT_EQ(clay, 8);
}

// A body without scatter has no fields for it, and neither has one that cannot crack.
TEST(Scatter, TakesNothingWhereThereIsNone) {
  EXPECT_EQ(make_model(read({"material.rock={youngs_modulus=1, poissons_ratio=0.2, density=1}"}), Communicator::world())
                .strength.components(),
            0);
  EXPECT_EQ(make_model(read({"material.rock.fracture.law=none"}), Communicator::world()).strength.components(), 0);
}

// Grains 1 and 2 meet between x = 1 and 2; from x = 4 on there is another material, but no other grain until a hole at
// x = 5 with a label of its own, which is no neighbour.
TEST(Grains, CellsNextToAnotherGrainAreTheBoundary) {
  Definition definition =
      read({"body.grain_boundary.strength=0.25", "material.rock.fracture.strength_scatter.modulus=1e6"});
  for (int row = 0; row < 4; ++row)
    for (const int label : {1, 1, 2, 2, 2, 7}) definition.body.grain_boundary->label_of_cells.push_back(label);
  RegionDefinition hole = definition.regions[0];
  hole.min[0] = 5e-3;
  hole.material = "void";
  definition.regions.push_back(hole);
  Model model = make_model(definition, Communicator::world());
  int cells = 0;
  lattice::for_each_owned(model.layout(), [&](auto i, auto, auto, auto n) {
    if (model.lattice.cell.component(0)[n] == 0) return;
    EXPECT_NEAR(model.strength_of(n), i == 1 || i == 2 ? 0.25 : 1, 1e-4) << i;
    ++cells;
  });
  EXPECT_EQ(cells, 20);

  // Without labels materials are grains; the boundary may become another material.
  definition.body.grain_boundary = GrainBoundaryDefinition{.material = "clay"};
  model = make_model(definition, Communicator::world());
  lattice::for_each_owned(model.layout(), [&](auto i, auto, auto, auto n) {
    if (i < 5 && model.lattice.cell.component(0)[n] != 0)
      EXPECT_EQ(model.lattice.cell.component(0)[n], i < 3 ? 1 : 2) << i;
  });
}

TEST(Scatter, WhatIsWrongIsSaidAtTheKey) {
  const std::string scatter = "material.rock.fracture.strength_scatter";
  const std::string grains = "body.grain_boundary=";
  const std::vector<std::pair<std::string, std::string>> wrong{
      {scatter + ".modulus=0.5", "modulus is 0.5; it must lie between 1 and 1e+06"},
      {scatter + "={}", "strength_scatter has no \"modulus\""},
      {scatter + ".distribution=normal", "strength_scatter has no \"variation\""},
      {scatter + ".distribution=uniform", "unknown distribution \"uniform\"; allowed: \"weibull\", \"normal\""},
      {scatter + "={distribution='normal', variation=0.5}",
       "so that three standard deviations leave all factors posit"},
      {scatter + ".seed=-1", "seed is -1; it must lie between 0 and"},
      {scatter + ".seed=0.5", "expected a whole number"},
      {scatter + ".correlation_length=-1", "correlation_length is -1 m; it must lie between 0 m and"},
      {scatter + ".correlation_length='11 cm'", "is more than 100 cells of 0.001 m; take at most 0.1 m"},
      {grains + "{}", "grain_boundary takes exactly one of material and strength"},
      {grains + "{material='clay', strength=1}", "grain_boundary takes exactly one of material and strength"},
      {grains + "{material='cley'}", "there is no material \"cley\"; did you mean \"clay\"?"},
      {grains + "{strength=0}", "strength is 0; it must lie between 1e-06 and 1e+06"},
      {grains + "{strength=1, labels='g.txt'}", "the file \"g.txt\" is in no known format"},
      {"body.strength=s.txt", "the file \"s.txt\" is in no known format"},
  };
  for (const auto& [options, message] : wrong)
    EXPECT_THAT([&] { check(read({options})); }, ThrowsMessage<InputError>(HasSubstr(message))) << options;

  EXPECT_THAT(
      [&] {
        read({"lattice.springs=plain", "material.rock.fracture.law=none"});
      },
      ThrowsMessage<InputError>(HasSubstr("cells have no springs of their own to multiply with lattice.")));
  Definition none = read();
  none.materials[0].fracture.reset();
  none.body.strengths.assign(24, 1.0F);
  EXPECT_THAT([&] { check(none); },
              ThrowsMessage<InputError>(HasSubstr("error: no material has a strength for this to ")));
  Definition zero = read();
  zero.body.strengths.assign(24, 1.0F);
  zero.body.strengths[7] = 0;
  const auto make = [](const Definition& definition) { make_model(definition, Communicator::world()); };
  EXPECT_THAT([&] { make(zero); }, ThrowsMessage<InputError>(HasSubstr(
                                       "the strength of cell (1, 1, 0) is 0 times its material's; factors are above")));
  Definition few = read({"body.grain_boundary.strength=0.5"});
  few.body.grain_boundary->label_of_cells.assign(7, 1);
  EXPECT_THAT([&] { make(few); },
              ThrowsMessage<InputError>(HasSubstr("there are labels for 7 cells, but the body has 6")));
}

}  // namespace
}  // namespace koshi::model
