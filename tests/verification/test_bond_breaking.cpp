// Bodies whose bonds break (theory, section 12, "Bonds that break"): forces against the bond law, and which bonds
// break.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "failure/bond_breaking.h"
#include "lattice/halo.h"
#include "mechanics/bond_law.h"
#include "mechanics/force_kernel.h"
#include "mechanics/plain_forces.h"
#include "support/breaking_block.h"

namespace koshi {
namespace {

using test::block_of_bonds;

void deform(const model::Model& model, model::State& state, const std::array<Vec3, 3>& gradient) {
  lattice::for_each(model.layout(), {-1, -1, -1}, model.layout().owned(), [&](auto i, auto j, auto k, auto n) {
    const Vec3 x = model.lattice.grid.position(model.layout().global({i, j, k}));
    for (std::size_t c = 0; c < 3; ++c) state.displacement.component(static_cast<int>(c))[n] = dot(gradient[c], x);
  });
}

// Bonds along x break where a block is strained by e along x: edges stretch by e, face diagonals by e/2, body diagonals
// by e/3. A block of 3 x 2 x 2 cells has 3 9 edges along x, 4 (3 2 3) = 72 face diagonals across them in two kinds of
// planes and 4 12 body diagonals; each cell 4, 8 and 4 of its 28.
TEST(BondBreaking, BreaksWhatIsStretchedTooFar) {
  model::Definition definition = block_of_bonds({3, 2, 2}, 0.01);
  definition.materials[0].fracture->critical_stretch = 1e-3;
  for (const auto& [strain, bonds, damage] : {std::tuple{0.999e-3, 0, 0.0},
                                              {1.001e-3, 27, 4 / 28.0},
                                              {1.999e-3, 27, 4 / 28.0},
                                              {2.001e-3, 27 + 72, 12 / 28.0},
                                              {3.001e-3, 27 + 72 + 48, 1.0}}) {
    model::Model model = model::make_model(definition, Communicator::world());
    model::State state(model);
    failure::BondBreaking breaking(model, state);
    deform(model, state, {Vec3{strain, 0, 0}, Vec3{}, Vec3{}});
    state.time = 1;
    breaking.follow(1e-9);
    EXPECT_EQ(breaking.count(), bonds) << strain;
    lattice::for_each_owned(model.layout(), [&, d = damage](auto i, auto j, auto k, auto n) {
      if (i == 3 || j == 2 || k == 2) return;
      EXPECT_NEAR(state.crack.component(0)[n], d, 1e-15);
      EXPECT_EQ(state.crack.component(model::crack_moment)[n], d == 1 ? 1 : 0);
      EXPECT_EQ(state.crack.component(14)[n], 0);
      if (d > 0) EXPECT_NEAR(state.crack.component(6)[n], 1, 1e-12) << "normal";
    });
    // Pushed together nothing breaks, however far.
    model::State pushed(model);
    failure::BondBreaking none(model, pushed);
    deform(model, pushed, {Vec3{-1, 0, 0}, Vec3{0, 0, 0}, Vec3{0, 0, 0}});
    none.follow(1e-9);
    EXPECT_EQ(none.count(), 0);
  }
}

// u_x = g y shears edges along y by g, those along x and z not at all, face diagonals in the plane by g/2 with a
// stretch of +-g/2. Cells are marked as sheared. Half as strong cells break at half of it.
TEST(BondBreaking, BreaksWhatIsShearedTooFar) {
  model::Definition definition = block_of_bonds({2, 3, 2}, 0.01);
  definition.materials[0].fracture->critical_stretch = 1e-2;
  definition.materials[0].fracture->critical_shear = 1e-3;
  for (const auto& [strength, shear, bonds] :
       {std::tuple{1.0F, 0.999e-3, 0}, {1.0F, 1.001e-3, 27}, {0.5F, 0.499e-3, 0}, {0.5F, 0.501e-3, 27}}) {
    definition.body.strengths.assign(12, strength);
    model::Model model = model::make_model(definition, Communicator::world());
    model::State state(model);
    failure::BondBreaking breaking(model, state);
    deform(model, state, {Vec3{0, shear, 0}, Vec3{}, Vec3{}});
    breaking.follow(1e-9);
    EXPECT_EQ(breaking.count(), bonds) << shear;
    EXPECT_EQ(state.crack.component(14)[model.layout().index(0, 0, 0)], bonds > 0 ? 1 : 0);
    // Turned as a whole, nothing is sheared.
    model::State turned(model);
    failure::BondBreaking none(model, turned);
    deform(model, turned, {Vec3{0, -0.1, 0}, Vec3{0.1, 0, 0}, Vec3{}});
    std::fill_n(turned.displacement.component(5), turned.displacement.stride(), 0.1);
    none.follow(1e-9);
    EXPECT_EQ(none.count(), 0);
  }
}

// Bonds that touch a material that does not break hold; those of two materials break by the energy of both: with the
// same springs and critical stretches 1e-3 and 3e-3 the bonds between them at sqrt((1 + 9)/2) 1e-3 = 2.236e-3.
TEST(BondBreaking, BondsBetweenMaterials) {
  model::Definition definition = block_of_bonds({2, 1, 1}, 0.01);
  definition.materials[0].fracture->critical_stretch = 1e-3;
  definition.materials.push_back(definition.materials[0]);
  definition.materials[1].name = "other";
  definition.body.cells = {1, 2};
  // Stretched along y: two edges of the outer planes each, two in the plane between.
  const auto count = [&](double strain) {
    model::Model model = model::make_model(definition, Communicator::world());
    model::State state(model);
    failure::BondBreaking breaking(model, state);
    deform(model, state, {Vec3{}, Vec3{0, strain, 0}, Vec3{}});
    breaking.follow(1e-9);
    return breaking.count();
  };
  definition.materials[1].fracture->critical_stretch = 3e-3;
  EXPECT_EQ(count(1.1e-3), 2);
  // Beyond 2e-3 the face diagonals of the first cell alone too: two across y in its plane across x, four across z.
  EXPECT_EQ(count(2.23e-3), 2 + 2 + 4);
  EXPECT_EQ(count(2.24e-3), 2 + 2 + 4 + 2);
  definition.materials[1].fracture.reset();
  EXPECT_EQ(count(1.1e-3), 2);
  EXPECT_EQ(count(1), 2 + 2 + 4 + 4);
}

// The kernel of whole bonds with what broken ones change against the plain kernel with these bonds left out, and the
// pressure of those that are shortened, to rounding.
TEST(BondBreaking, ForcesAreThoseOfTheBondsThatAreLeft) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal(0, 1e-5);
  model::Definition definition = block_of_bonds({5, 4, 3}, 0.01);
  definition.body.cells.assign(60, 1);
  for (const std::size_t empty : {0, 17, 33}) definition.body.cells[empty] = 0;
  for (std::size_t c = 0; c < 60; ++c) definition.body.factors.push_back(static_cast<float>(1 + c % 5) / 5);
  model::Model model = model::make_model(definition, Communicator::world());
  model::State state(model);
  lattice::for_each_owned(model.layout(), [&](auto, auto, auto, auto n) {
    for (int c = 0; c < model.components(); ++c) state.displacement.component(c)[n] = normal(random);
    unsigned mask = 0;
    for (int slot = 0; slot < lattice::slot_count; ++slot) mask |= (random() % 3 == 0 ? 1U : 0U) << slot;
    state.bonds.component(0)[n] = mask;
  });
  lattice::Field<double> whole, left;
  lattice::Field<std::uint8_t> cells;
  make_bonds(model.lattice, whole, cells);
  failure::BondBreaking breaking(model, state);
  make_bonds(model.lattice, left, cells);

  lattice::Field<double> force(model.layout(), model.components()), expected(model.layout(), model.components());
  mechanics::ForceKernel kernel(model.lattice);
  kernel.apply(state.displacement, force);
  const mechanics::PlainForces plain(model.lattice);
  const Int3& owned = model.layout().owned();
  for (std::int64_t k = 0; k < owned[2]; ++k)
    for (std::int64_t j = 0; j < owned[1]; ++j) {
      std::array<double*, 6> sum{}, exact{};
      for (int c = 0; c < model.components(); ++c) {
        sum[static_cast<std::size_t>(c)] = force.component(c) + model.layout().index(0, j, k);
        exact[static_cast<std::size_t>(c)] = expected.component(c) + model.layout().index(0, j, k);
      }
      breaking.add_forces(j, k, sum.data());
      plain.row(state.displacement, j, k, exact.data());
    }
  int closed = 0, gone = 0;
  double energy = 0;
  lattice::for_each_owned(model.layout(), [&](auto, auto, auto, auto n) {
    for (int slot = 0; slot < lattice::slot_count; ++slot) {
      const double kn = whole.component(2 * slot)[n];
      if (kn == 0 || left.component(2 * slot)[n] != 0) continue;
      ++gone;
      const auto& s = lattice::slots[static_cast<std::size_t>(slot)].s;
      const std::int64_t other = n + model.layout().offset(s);
      Vec3 r{};
      for (int c = 0; c < 3; ++c)
        r[static_cast<std::size_t>(c)] = state.displacement.component(c)[n] - state.displacement.component(c)[other];
      const Vec3 D{-0.01 * s[0], -0.01 * s[1], -0.01 * s[2]};
      if (dot(r, D) >= 0) continue;
      ++closed;
      energy += mechanics::bond_energy(kn, 0, D, r);
      const Vec3 F = mechanics::bond_force(kn, 0, D, r);
      for (int c = 0; c < 3; ++c) {
        expected.component(c)[n] -= F[static_cast<std::size_t>(c)];
        expected.component(c)[other] += F[static_cast<std::size_t>(c)];
      }
    }
  });
  EXPECT_GT(gone, 300);
  EXPECT_GT(closed, 100);
  double largest = 0, difference = 0, intact_energy = 0, energy_left = 0;
  lattice::Field<double> intact(model.layout(), model.components());
  kernel.apply(state.displacement, intact);
  lattice::for_each_owned(model.layout(), [&](auto, auto, auto, auto n) {
    for (int c = 0; c < model.components(); ++c) {
      largest = std::max(largest, std::abs(expected.component(c)[n]));
      difference = std::max(difference, std::abs(force.component(c)[n] - expected.component(c)[n]));
      intact_energy -= 0.5 * state.displacement.component(c)[n] * intact.component(c)[n];
      energy_left -= 0.5 * state.displacement.component(c)[n] * force.component(c)[n];
    }
  });
  EXPECT_LT(difference / largest, 1e-13);
  // Stored energy: homogeneous of degree two, so that it is -u.F/2 also with closed bonds.
  mechanics::Balance balance;
  breaking.complete(balance);
  EXPECT_NEAR((intact_energy + balance.elastic_energy) / energy_left, 1, 1e-12);
  EXPECT_GT(energy, 0.01 * energy_left);
}

// One side of a plane of normal n is drawn off along n, slowly. What the cells of the columns in the middle have taken,
// over the area of the plane in them, is what the bonds that cross it hold when they break: the table of the theory for
// nu = 0.2. A step moves by a hundredth of the way on which they break, and r_n r_{n+1} is right to its square.
TEST(BondBreaking, PlanesTakeTheirEnergy) {
  const double r = 1 / std::numbers::sqrt2, s = std::numbers::inv_sqrt3;
  for (const auto& [n, energy] : {std::pair{Vec3{0, 1, 0}, 1.0}, {Vec3{r, r, 0}, 1.042}, {Vec3{s, s, s}, 1.074}}) {
    const double d = 0.01;
    model::Model model = model::make_model(block_of_bonds({12, 12, 12}, d), Communicator::world());
    model::State state(model);
    failure::BondBreaking breaking(model, state);
    const double step = 0.01 * d * failure::critical_stretch(model.lattice.springs[1], 100);
    const double middle = dot(n, {0.06, 0.0649, 0.06});
    for (int at = 1; at <= 600; ++at) {
      lattice::for_each_owned(model.layout(), [&, n = n](auto i, auto j, auto k, auto node) {
        if (dot(n, model.lattice.grid.position({i, j, k})) < middle) return;
        for (std::size_t c = 0; c < 3; ++c) {
          state.displacement.component(static_cast<int>(c))[node] = at * step * n[c];
          state.velocity.component(static_cast<int>(c))[node] = step * n[c];
        }
      });
      breaking.follow(1);
    }
    double taken = 0;
    lattice::for_each_owned(model.layout(), [&](auto i, auto, auto k, auto node) {
      if (i >= 4 && i < 8 && k >= 4 && k < 8) taken += state.crack.component(model::crack_moment - 1)[node];
    });
    EXPECT_NEAR(taken * n[1] / (16 * d * d) / 100, energy, 0.005);
  }
}

// Cracks from the start. A plane across x cuts the bonds between two layers of 5 x 5 nodes: 25 edges, 2 (2 4 5) = 80
// face diagonals and 4 16 body diagonals; through nodes it cuts the layer above. A narrower piece of y below 0.02 cuts
// those whose middle lies there, or just on its end: three rows of 5 edges, with 8 diagonals across y in the plane of
// each, and of the two spaces between them 2 in each of 5 planes across z and 16 body diagonals.
TEST(BondBreaking, CracksFromTheStart) {
  model::CrackDefinition crack;
  crack.shape = model::CrackDefinition::Shape::rectangle;
  crack.center = {0.03, 0, 0.02};
  crack.normal = {1, 0, 0};
  crack.along = {0, 1, 0};
  crack.width = 1;
  for (const auto& [x, length, bonds] : {std::tuple{0.03, 1.0, 25 + 80 + 64},
                                         {0.0399, 1.0, 25 + 80 + 64},
                                         {0.045, 0.04, 3 * 5 + 3 * 8 + 2 * 2 * 5 + 4 * 8}}) {
    model::Definition definition = block_of_bonds({6, 4, 4}, 0.01);
    crack.center[0] = x;
    crack.length = length;
    definition.pre_cracks = {crack};
    model::Model model = model::make_model(definition, Communicator::world());
    model::State state(model);
    failure::BondBreaking breaking(model, state);
    EXPECT_EQ(breaking.count(), bonds) << x;
    EXPECT_EQ(state.crack.component(0)[model.layout().index(x < 0.04 ? 3 : 4, 0, 0)], 1);
    EXPECT_EQ(state.crack.component(0)[model.layout().index(2, 0, 0)], 0);
    EXPECT_EQ(breaking.energy_taken(), 0);
  }
}

// Sides of an oblique crack that are drawn apart as they are feel nothing.
TEST(BondBreaking, SidesOfACrackComeApart) {
  for (const Vec3& n : {Vec3{0, 0, 1}, {1, 1, 0}, {1, -2, 3}}) {
    model::CrackDefinition crack;
    crack.center = {0.026, 0.027, 0.0281};
    crack.normal = n;
    crack.radius = 1;
    model::Definition definition = block_of_bonds({5, 5, 5}, 0.01);
    definition.pre_cracks = {crack};
    definition.materials[0].fracture->critical_stretch = 0.5;
    model::Model model = model::make_model(definition, Communicator::world());
    model::State state(model);
    failure::BondBreaking breaking(model, state);
    int moved = 0;
    lattice::for_each(model.layout(), {-1, -1, -1}, model.layout().owned(), [&](auto i, auto j, auto k, auto node) {
      if (dot(n, model.lattice.grid.position({i, j, k}) - crack.center) < 0) return;
      ++moved;
      for (std::size_t c = 0; c < 3; ++c) state.displacement.component(static_cast<int>(c))[node] = 1e-4 * n[c];
    });
    EXPECT_GT(moved, 50);
    breaking.follow(1e-9);
    lattice::Field<double> force(model.layout(), model.components());
    mechanics::ForceKernel(model.lattice).apply(state.displacement, force);
    double largest = 0, left = 0;
    lattice::for_each_owned(model.layout(), [&](auto, auto, auto, auto node) {
      for (int c = 0; c < model.components(); ++c) {
        largest = std::max(largest, std::abs(force.component(c)[node]));
        left = std::max(left, std::abs(force.component(c)[node] + state.face_force.component(c)[node]));
      }
    });
    EXPECT_GT(largest, 1e3);
    EXPECT_LT(left / largest, 1e-12) << n[0] << n[1] << n[2];
  }
}

}  // namespace
}  // namespace koshi
