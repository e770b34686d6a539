// Equilibrium against a sparse direct solve of the assembled matrix, on small bodies of every kind.
#include <gtest/gtest.h>

#include <Eigen/SparseCholesky>

#include <random>

#include "koshi/statics.h"
#include "lattice/halo.h"
#include "mechanics/force_kernel.h"
#include "mechanics/loads.h"

namespace koshi {
namespace {

using material::Kinematics;
using material::Sharing;

struct Case {
  const char* name;
  lattice::CellType cell;
  Sharing sharing;
  Kinematics kinematics;
  double nu;
  Int3 cells;
  bool mixed;       ///< two materials and voids, else one material
  bool prescribed;  ///< the far end is displaced and turned, else loaded
  std::array<bool, 3> periodic{};
};

std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }

// A block held at z = 0; displacements of an inner box are prescribed too.
model::Definition definition_of(const Case& c) {
  constexpr double d = 0.01;
  model::Definition definition;
  definition.lattice = {c.cell, d, c.sharing, {}, c.kinematics, {}, "xyz"};
  definition.body.size = {d * static_cast<double>(c.cells[0]), d * static_cast<double>(c.cells[1]),
                          d * static_cast<double>(c.cells[2])};
  definition.body.periodic = c.periodic;
  definition.materials = {{"hard", {3e9, c.nu, 2000}}, {"soft", {2e8, 0.2, 1000}}};
  std::mt19937 random(7);
  for (std::int64_t n = 0; n < c.cells[0] * c.cells[1] * c.cells[2]; ++n) {
    // Whole layers at both ends, so that nothing hangs loose there; one cell in six empty, one in three soft.
    const bool inner = n >= c.cells[0] * c.cells[1] && n < c.cells[0] * c.cells[1] * (c.cells[2] - 1);
    const auto draw = random() % 6;
    definition.body.cells.push_back(!c.mixed || !inner ? 1 : draw == 0 ? 0 : draw < 3 ? 2 : 1);
  }

  model::BoundaryDefinition bottom, top, box;
  bottom.name = "bottom";
  bottom.selection.face = model::Face::z_min;
  bottom.fix.fill(true);
  box.name = "box";
  box.selection.box = {Vec3{2.9 * d, 1.9 * d, 2.9 * d}, Vec3{3.1 * d, 3.1 * d, 3.1 * d}};
  box.displacement[0] = 1e-5;
  definition.boundaries = {bottom, box};
  if (c.prescribed) {
    top.name = "top";
    top.selection.face = model::Face::z_max;
    top.displacement[2] = -2e-5;
    top.displacement[0] = 1e-5;
    if (c.kinematics == Kinematics::rotational) top.displacement[4] = 1e-3;
    definition.boundaries.push_back(top);
  } else {
    model::LoadDefinition load;
    load.name = "top";
    load.selection.face = model::Face::z_max;
    load.force = Vec3{70, -20, 40};
    model::LoadDefinition weight;
    weight.acceleration = Vec3{0, 1, -9.81};
    definition.loads = {load, weight};
  }
  return definition;
}

// Every column of K by the force kernel (checked elsewhere against a sum over bonds), prescribed components taken to
// the right-hand side.
lattice::Field<double> direct_solution(const model::Model& model) {
  const lattice::Layout& layout = model.layout();
  const int components = model.components();
  std::vector<std::int64_t> nodes;
  lattice::for_each_owned(layout, [&](auto, auto, auto, auto n) {
    if (model.inertia.component(0)[n] > 0) nodes.push_back(n);
  });
  const auto size = static_cast<Eigen::Index>(nodes.size()) * components;
  mechanics::ForceKernel kernel(model.lattice);
  lattice::Field<double> u(layout, components), force(layout, components);
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd b = Eigen::VectorXd::Zero(size), value = Eigen::VectorXd::Zero(size);
  std::vector<bool> held(static_cast<std::size_t>(size), false);
  const auto index = [&](std::int64_t node, int c) {
    return (std::lower_bound(nodes.begin(), nodes.end(), node) - nodes.begin()) * components + c;
  };
  for (const model::PrescribedMotion& motion : model.motions) {
    held[static_cast<std::size_t>(index(motion.node, motion.component))] = true;
    value(index(motion.node, motion.component)) = motion.value;
  }
  mechanics::LoadRows loads(model);
  loads.set_time(0);
  force.zero();
  for (std::int64_t k = 0; k < layout.owned()[2]; ++k)
    for (std::int64_t j = 0; j < layout.owned()[1]; ++j) {
      std::array<double*, 6> row;
      for (int c = 0; c < components; ++c)
        row[static_cast<std::size_t>(c)] = force.component(c) + layout.index(0, j, k);
      loads.add(j, k, row.data());
    }
  for (Eigen::Index i = 0; i < size; ++i)
    b(i) = force.component(static_cast<int>(i % components))[nodes[static_cast<std::size_t>(i / components)]];
  for (Eigen::Index column = 0; column < size; ++column) {
    u.zero();
    u.component(static_cast<int>(column % components))[nodes[static_cast<std::size_t>(column / components)]] = 1;
    kernel.apply(u, force);
    for (Eigen::Index i = 0; i < size; ++i) {
      const double K =
          -force.component(static_cast<int>(i % components))[nodes[static_cast<std::size_t>(i / components)]];
      if (K == 0 || held[static_cast<std::size_t>(i)]) continue;
      if (held[static_cast<std::size_t>(column)])
        b(i) -= K * value(column);
      else
        entries.emplace_back(i, column, K);
    }
    if (held[static_cast<std::size_t>(column)]) {
      entries.emplace_back(column, column, 1.0);
      b(column) = value(column);
    }
  }
  Eigen::SparseMatrix<double> K(size, size);
  K.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(K);
  EXPECT_EQ(factor.info(), Eigen::Success);
  const Eigen::VectorXd x = factor.solve(b);
  u.zero();
  for (Eigen::Index i = 0; i < size; ++i)
    u.component(static_cast<int>(i % components))[nodes[static_cast<std::size_t>(i / components)]] = x(i);
  return u;
}

class Direct : public testing::TestWithParam<Case> {};

TEST_P(Direct, GivesTheSameDisplacements) {
  const model::Model model = model::make_model(definition_of(GetParam()), Communicator::world());
  model::State state(model);
  statics::StaticOptions options;
  options.tolerance = 1e-12;
  const auto report = statics::solve_static(model, state, options);
  EXPECT_TRUE(report.converged);
  EXPECT_LE(report.relative_residual, 1e-12);
  EXPECT_EQ(report.unknowns, model.node_count * model.components() - model.motion_count);
  const auto expected = direct_solution(model);

  // Displacements and rotations each against their own size. Rotations of Cube-I have a checkerboard that no spring
  // resists: layers of nodes may turn against their neighbours.
  const bool loose = GetParam().cell == lattice::CellType::cube_i;
  const int compared = loose ? 3 : model.components();
  int checked = 0;
  for (int first = 0; first < compared; first += 3) {
    double largest = 0, error = 0;
    for (int c = first; c < first + 3; ++c)
      lattice::for_each_owned(model.layout(), [&](auto, auto, auto, auto n) {
        largest = std::max(largest, std::abs(expected.component(c)[n]));
        error = std::max(error, std::abs(expected.component(c)[n] - state.displacement.component(c)[n]));
        ++checked;
      });
    EXPECT_GT(largest, 1e-8);
    EXPECT_LT(error, 1e-9 * largest) << "component " << first;
  }
  EXPECT_EQ(checked, model.layout().owned_count() * compared);
}

std::vector<Case> cases() {
  using enum lattice::CellType;
  constexpr auto shared = Sharing::shared, plain = Sharing::plain;
  constexpr auto rotational = Kinematics::rotational, least_squares = Kinematics::least_squares;
  const Int3 even{6, 4, 6}, odd{5, 5, 7};
  return {
      {"uniform", cube_iii, shared, rotational, 0.25, even, false, false},
      {"uniform_odd", cube_iii, shared, rotational, 0.25, odd, false, true},
      {"mixed", cube_iii, shared, rotational, 0.3, even, true, false},
      {"mixed_odd_prescribed", cube_iii, shared, rotational, 0.1, odd, true, true},
      {"cube_ii", cube_ii, shared, rotational, -0.3, odd, true, false},
      {"cube_ii_plain", cube_ii, plain, rotational, 0.2, odd, true, false},
      {"cube_iii_plain", cube_iii, plain, rotational, 0.2, even, false, true},
      {"cube_i_plain", cube_i, plain, rotational, 0.2, odd, false, false},
      {"least_squares", cube_iii, shared, least_squares, 0.25, odd, true, false},
      {"least_squares_cube_i", cube_i, shared, least_squares, 0.3, even, false, true},
      {"least_squares_cube_ii", cube_ii, shared, least_squares, 0.45, odd, false, false},
      {"least_squares_plain", cube_iii, plain, least_squares, 0.1, odd, false, true},
      {"incompressible", cube_iii, shared, rotational, 0.49, odd, false, false},
      {"incompressible_mixed", cube_ii, shared, rotational, 0.499, even, true, true},
      {"periodic_even", cube_iii, shared, rotational, 0.25, even, true, false, {true, true, false}},
      {"periodic_odd", cube_iii, shared, least_squares, 0.25, odd, true, true, {true, false, false}},
  };
}

INSTANTIATE_TEST_SUITE_P(Statics, Direct, testing::ValuesIn(cases()),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace koshi
