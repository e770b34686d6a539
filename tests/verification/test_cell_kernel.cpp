// The cell kernel against the plain kernel, its specification, where every cell is another one.
#include <gtest/gtest.h>

#include <random>
#include <set>

#include "mechanics/cell_stress.h"
#include "mechanics/force_kernel.h"
#include "mechanics/plain_forces.h"
#include "support/bodies.h"

namespace koshi {
namespace {

using material::Kinematics;
using material::Sharing;
using material::Springs;

// More than two strips of cells along x, the last one not whole; one cell in ten is empty.
constexpr Int3 box{75, 9, 7};
constexpr double d = 0.8;

std::size_t number_of(const Int3& cell) {
  return static_cast<std::size_t>(cell[0] + box[0] * (cell[1] + box[1] * cell[2]));
}

std::vector<std::uint16_t> random_cells(int materials) {
  std::mt19937 random(7);
  std::vector<std::uint16_t> cells(static_cast<std::size_t>(box[0] * box[1] * box[2]));
  for (auto& m : cells)
    m = static_cast<std::uint16_t>(random() % 10 == 0 ? 0 : 1 + random() % static_cast<unsigned>(materials));
  return cells;
}

// Springs of `count` materials without any symmetry between families, all about as stiff as each other.
std::vector<Springs> random_springs(int count) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> about_one(0.5, 1.5);
  std::vector<Springs> springs(1);
  for (int m = 0; m < count; ++m) {
    Springs s;
    for (int f = 0; f < lattice::family_count; ++f) {
      s.kn[f] = about_one(random);
      s.kt[f] = 0.3 * about_one(random);
    }
    s.kappa = about_one(random);
    springs.push_back(s);
  }
  return springs;
}

lattice::Field<double> random_motion(const model::SpringLattice& body) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> uniform(-1, 1);
  lattice::Field<double> u(body.layout, body.components());
  for (int c = 0; c < body.components(); ++c)
    lattice::for_each_owned(body.layout, [&](auto, auto, auto, auto n) { u.component(c)[n] = uniform(random); });
  body.halo->exchange(u);
  return u;
}

// Largest difference between the two kernels, over the largest force.
double difference(const model::SpringLattice& body, mechanics::ForceKernel& kernel) {
  const lattice::Field<double> u = random_motion(body);
  const mechanics::PlainForces plain(body);
  const auto nodes = static_cast<std::size_t>(body.layout.owned()[0]);
  std::vector<std::vector<double>> row(static_cast<std::size_t>(body.components()),
                                       std::vector<double>(nodes + lattice::Layout::lead));
  std::array<double*, 6> expected{};
  for (std::size_t c = 0; c < row.size(); ++c) expected[c] = row[c].data();
  double largest = 0, error = 0;
  std::int64_t rows = 0;
  kernel.for_each_row(u, [&](std::int64_t j, std::int64_t k, double* const* force) {
    plain.row(u, j, k, expected.data());
    ++rows;
    for (std::size_t c = 0; c < row.size(); ++c)
      for (std::size_t i = 0; i < nodes; ++i) {
        largest = std::max(largest, std::abs(row[c][i]));
        error = std::max(error, std::abs(row[c][i] - force[c][i]));
      }
  });
  EXPECT_EQ(rows, body.layout.owned()[1] * body.layout.owned()[2]);
  EXPECT_GT(largest, 1.0);
  return error / largest;
}

class CellKernel : public testing::TestWithParam<std::pair<Kinematics, bool>> {
 protected:
  static model::SpringLattice body(int materials) {
    const auto cells = random_cells(materials);
    const bool periodic = GetParam().second;
    return test::make_body(box, d, Sharing::shared, GetParam().first, random_springs(materials),
                           [&](const Int3& cell) { return cells[number_of(cell)]; }, {periodic, periodic, false});
  }
  static void give_random_factors(model::SpringLattice& body, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform(0, 1);
    std::vector<float> factors(static_cast<std::size_t>(box[0] * box[1] * box[2]));
    for (float& s : factors) s = random() % 10 == 0 ? 0 : uniform(random);
    model::make_factors(body, [&](const Int3& cell) { return factors[number_of(cell)]; });
  }
};

// Both sum the same few hundred terms: 1e-13 of the largest force is some hundred units in the last place.
TEST_P(CellKernel, TenThousandMaterials) {
  const model::SpringLattice b = body(10000);
  mechanics::ForceKernel kernel(b);
  EXPECT_LT(difference(b, kernel), 1e-13);
}

TEST_P(CellKernel, AFactorForEachCell) {
  model::SpringLattice b = body(3);
  give_random_factors(b, 1);
  mechanics::ForceKernel kernel(b);
  EXPECT_LT(difference(b, kernel), 1e-13);
}

// A kernel that stands follows the lattice's factors.
TEST_P(CellKernel, FactorsMayChangeBetweenCalls) {
  model::SpringLattice b = body(1);
  give_random_factors(b, 1);
  mechanics::ForceKernel kernel(b);
  EXPECT_LT(difference(b, kernel), 1e-13);
  give_random_factors(b, 2);
  EXPECT_LT(difference(b, kernel), 1e-13);
  for (std::size_t n = 0; n < b.factor.count(); ++n) b.factor.data()[n] = 1;
  EXPECT_LT(difference(b, kernel), 1e-13);
}

// Cells all alike with factor 1 give the same bits as without factors.
TEST_P(CellKernel, FactorsOfOneChangeNothing) {
  model::SpringLattice b = body(5);
  const lattice::Field<double> u = random_motion(b);
  const auto forces = [&] {
    mechanics::ForceKernel kernel(b);
    std::vector<double> all;
    kernel.for_each_row(u, [&](auto, auto, double* const* force) {
      for (int c = 0; c < b.components(); ++c) all.insert(all.end(), force[c], force[c] + b.layout.owned()[0]);
    });
    return all;
  };
  const std::vector<double> without = forces();
  model::make_factors(b, [](const Int3&) { return 1.0f; });
  EXPECT_EQ(without, forces());
}

// A row has the same bits whatever rows are asked for with it: ranks and blocks of rows do not show.
TEST_P(CellKernel, RowsDoNotDependOnTheirCompany) {
  model::SpringLattice b = body(100);
  const lattice::Field<double> u = random_motion(b);
  mechanics::ForceKernel kernel(b);
  lattice::Field<double> all(b.layout, b.components());
  lattice::Field<double> input = u;
  kernel.apply(input, all);
  int rows = 0, released = 0;
  std::set<std::int64_t> fetched;
  for (const mechanics::Rows& part :
       {mechanics::Rows{2, 5, 1, 4}, {0, 1, 0, 7}, {3, b.layout.owned()[1], 6, 7}, {4, 4, 0, 7}})
    kernel.for_each_row(
        u, part, [&](std::int64_t n) { fetched.insert(n); },
        [&](std::int64_t j, std::int64_t k, double* const* force) {
          ++rows;
          EXPECT_TRUE(fetched.contains(b.layout.index(0, j, k))) << "what is used has been fetched";
          for (int c = 0; c < b.components(); ++c)
            for (std::int64_t i = 0; i < b.layout.owned()[0]; ++i)
              ASSERT_EQ(force[c][i], all.component(c)[b.layout.index(i, j, k)]) << i << " " << j << " " << k;
        },
        [&](std::int64_t, std::int64_t) { ++released; });
  EXPECT_EQ(rows, 9 + 7 + b.layout.owned()[1] - 3);
  EXPECT_EQ(released, rows);
  EXPECT_GE(fetched.size(), static_cast<std::size_t>(rows));
}

// Stress and energy of cells scale with their factor.
TEST_P(CellKernel, StressAndEnergyFollowTheFactor) {
  model::SpringLattice b = body(2);
  const lattice::Field<double> u = random_motion(b);
  std::int64_t solid = -1;
  lattice::for_each_owned(b.layout, [&](auto i, auto j, auto k, auto n) {
    if (solid < 0 && i > 0 && j > 0 && k > 0 && b.cell.component(0)[n] != 0) solid = n;
  });
  ASSERT_GE(solid, 0);
  const mechanics::CellState whole = mechanics::cell_state(b, u, solid);
  model::make_factors(b, [](const Int3&) { return 0.25f; });
  const mechanics::CellState quarter = mechanics::cell_state(b, u, solid);
  EXPECT_GT(std::abs(whole.stress[0]), 0.01);
  for (int v = 0; v < 6; ++v) EXPECT_NEAR(quarter.stress[v], 0.25 * whole.stress[v], 1e-14);
  EXPECT_NEAR(quarter.energy, 0.25 * whole.energy, 1e-14);
}

INSTANTIATE_TEST_SUITE_P(All, CellKernel,
                         testing::Values(std::pair{Kinematics::rotational, false},
                                         std::pair{Kinematics::rotational, true},
                                         std::pair{Kinematics::least_squares, false},
                                         std::pair{Kinematics::least_squares, true}));

}  // namespace
}  // namespace koshi
