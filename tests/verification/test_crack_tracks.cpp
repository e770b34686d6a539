// Where cracks go on, on several ranks (theory, section 12, "Where a crack goes").
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "failure/crack_tracks.h"
#include "failure/fracturing.h"
#include "lattice/halo.h"
#include "support/cases.h"

namespace koshi {
namespace {

using failure::Crack;
using failure::CrackTracks;
using failure::Fracturing;

constexpr double d = 0.01;

model::Model block(const Int3& cells) {
  model::Definition definition = test::block(cells, d, {30e9, 0.2, 2400});
  definition.materials[0].fracture.emplace();
  definition.materials[0].fracture->tensile_strength = 3e6;
  definition.materials[0].fracture->fracture_energy = 100;
  return model::make_model(definition, Communicator::world());
}

Vec3 unit(const Vec3& v) { return (1 / norm(v)) * v; }

// A crack in one cell of the body, wherever it is.
void put(const model::Model& model, model::State& state, const Int3& cell, const Vec3& normal, double offset) {
  const Int3 here = model.layout().local(cell);
  if (model.layout().owns(here)) {
    const std::int64_t n = model.layout().index(here);
    state.crack.component(Fracturing::kappa)[n] = 1e-4;
    for (int a = 0; a < 3; ++a) state.crack.component(Fracturing::normal + a)[n] = normal[static_cast<std::size_t>(a)];
    state.crack.component(Fracturing::offset)[n] = offset;
  }
  model.lattice.halo->exchange(state.crack);
}

Crack crack(const Vec3& normal, bool shear = false) {
  Crack crack;
  crack.normal = normal;
  crack.shear = shear;
  return crack;
}

bool beside(const Int3& a, const Int3& b) {
  bool near = a != b;
  for (std::size_t c = 0; c < 3; ++c) near = near && std::abs(a[c] - b[c]) <= 1;
  return near;
}

// All cells that the rank follows.
template <class F>
void for_each_followed(const model::Model& model, F&& f) {
  lattice::for_each(model.layout(), {-1, -1, -1}, model.layout().owned(), [&](auto i, auto j, auto k, auto n) {
    if (model.lattice.cell.component(0)[n] != 0) f(model.layout().global({i, j, k}), n);
  });
}

// One cracked cell, its plane a fifth of a cell off its middle. Which neighbours it cuts is told by their corners: some
// on one side of the plane, some on the other. Those take up the plane where it is, the others hold 1.5 f_t, and if
// they crack by then a crack that goes the same way has no plane of its own. Cells further away know nothing.
TEST(CrackTracks, GoOnInTheCellsThatThePlaneCuts) {
  const model::Model model = block({9, 8, 7});
  model::State state(model);
  const Int3 from{4, 4, 3};
  const Vec3 normal = unit({2, -1, 0.7}), other = unit({2, -0.8, 1}), across = unit({1, 2, 0});
  put(model, state, from, normal, 0.2 * d);
  CrackTracks tracks(model, state);
  tracks.restore();
  std::array<std::int64_t, 2> seen{};
  for_each_followed(model, [&](const Int3& cell, std::int64_t n) {
    if (!beside(cell, from)) {
      EXPECT_EQ(tracks.hold(n, crack(normal)), 1);
      EXPECT_EQ(tracks.offset(n, crack(normal)), 0);
      return;
    }
    const auto above = [&](double x, double y, double z) {
      return dot(normal, Vec3{cell[0] - from[0] + x, cell[1] - from[1] + y, cell[2] - from[2] + z}) * d - 0.2 * d;
    };
    int up = 0;
    for (int c = 0; c < 8; ++c) up += above((c & 1) - 0.5, (c >> 1 & 1) - 0.5, (c >> 2) - 0.5) > 0;
    const bool cut = up > 0 && up < 8;
    if (model.layout().owns(model.layout().place(n))) ++seen[cut];
    EXPECT_EQ(tracks.hold(n, crack(normal)), cut ? 1 : 1.5);
    EXPECT_EQ(tracks.hold(n, crack(normal, true)), 1);
    if (!cut) {
      EXPECT_TRUE(std::isinf(tracks.offset(n, crack(other))));
      EXPECT_EQ(tracks.offset(n, crack(across)), 0);
      EXPECT_EQ(tracks.lead(n), Vec3{});
      return;
    }
    EXPECT_NEAR(dot(tracks.lead(n), normal), 1, 1e-6);
    const double middle = -above(0, 0, 0);
    EXPECT_NEAR(tracks.offset(n, crack(normal)), middle, 1e-7 * d);
    // The plane's foot of the perpendicular, seen along another normal; a crack's plane cuts its own cell.
    const double half = 0.5 * failure::band_width(d, other);
    EXPECT_NEAR(tracks.offset(n, crack(other)), std::clamp(middle * dot(normal, other), -half, half), 1e-6 * d);
    EXPECT_TRUE(std::isinf(tracks.offset(n, crack(other, true))));
  });
  // Nine columns along x, of each of which it cuts 1 + (1 + 0.7)/2 cells on average, are 16.65, less the cell itself.
  EXPECT_EQ(model.communicator.sum(seen[0]) + model.communicator.sum(seen[1]), 26);
  EXPECT_EQ(model.communicator.sum(seen[1]), 16);
}

// Two planes of opposite sign lead to the cell between them, one through its middle +0.1 d and -0.3 d, from a face and
// from an edge: (1 * 0.1 - 0.5 * 0.3)/1.5 d by (12.7).
TEST(CrackTracks, TakeUpThePlanesAround) {
  const model::Model model = block({9, 8, 7});
  model::State state(model);
  put(model, state, {3, 4, 3}, {0, 1, 0}, 0.1 * d);
  put(model, state, {5, 4, 4}, {0, -1, 0}, 0.3 * d);
  CrackTracks tracks(model, state);
  tracks.restore();
  std::int64_t seen = 0;
  for_each_followed(model, [&](const Int3& cell, std::int64_t n) {
    if (cell != Int3{4, 4, 3}) return;
    ++seen;
    for (const double sign : {1, -1})
      EXPECT_NEAR(tracks.offset(n, crack({0, sign, 0})), sign * (0.1 - 0.5 * 0.3) / 1.5 * d, 1e-7 * d);
  });
  EXPECT_GE(model.communicator.sum(seen), 1);
}

// Cracks that were there from the start have no plane.
TEST(CrackTracks, PreCracksLeadNowhere) {
  const model::Model model = block({5, 4, 4});
  model::State state(model);
  put(model, state, {2, 2, 2}, {0, 1, 0}, std::numeric_limits<double>::infinity());
  CrackTracks tracks(model, state);
  tracks.restore();
  std::int64_t seen = 0;
  for_each_followed(model, [&](const Int3&, std::int64_t n) {
    ++seen;
    EXPECT_EQ(tracks.hold(n, crack({0, 1, 0})), 1);
  });
  EXPECT_GT(seen, 0);
}

// Cells that crack one after the other, or all found again from the state: the same, also beyond the borders of ranks
// and of a period.
TEST(CrackTracks, FollowWhatBegins) {
  for (const bool periodic : {false, true}) {
    model::Definition definition = test::block({9, 8, 7}, d, {30e9, 0.2, 2400});
    definition.materials[0].fracture.emplace();
    definition.materials[0].fracture->tensile_strength = 3e6;
    definition.materials[0].fracture->fracture_energy = 100;
    if (periodic) definition.body.periodic = {true, false, true};
    const model::Model model = model::make_model(definition, Communicator::world());
    model::State state(model);
    CrackTracks tracks(model, state);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(-1, 1);
    std::uniform_int_distribution<std::int64_t> place(0, 6);
    for (int step = 0; step < 25; ++step) {
      const Int3 cell{place(random), place(random), place(random)};
      const Vec3 normal = unit({any(random), any(random), any(random)});
      put(model, state, cell, normal, 0.4 * d * any(random));
      std::vector<std::int64_t> begun;
      lattice::for_each(model.layout(), {-1, -1, -1}, model.layout().owned(), [&](auto, auto, auto, auto n) {
        const auto at = [&](int c) { return state.crack.component(Fracturing::normal + c)[n]; };
        if (Vec3{at(0), at(1), at(2)} == normal) begun.push_back(n);
      });
      tracks.follow(begun);
    }
    CrackTracks again(model, state);
    again.restore();
    std::int64_t held = 0;
    for_each_followed(model, [&](const Int3&, std::int64_t n) {
      const Crack next = crack(unit({1, 2, 3}));
      EXPECT_EQ(tracks.hold(n, next), again.hold(n, next));
      EXPECT_EQ(tracks.offset(n, next), again.offset(n, next));
      held += tracks.hold(n, next) > 1;
    });
    EXPECT_GT(model.communicator.sum(held), 20);
  }
}

}  // namespace
}  // namespace koshi
