// Supports by surfaces: what they hold, what they let go, what they carry, on any number of ranks.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "driver/simulation.h"
#include "koshi/error.h"
#include "koshi/input.h"
#include "lattice/halo.h"
#include "mechanics/stable_step.h"
#include "model/surface_supports.h"
#include "support/first_ranks.h"
#include "support/state_bits.h"

namespace koshi {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double E = 1e9, nu = 0.25, mu = 4e8, wave_modulus = 1.2e9;

model::Definition read(const std::string& text) { return io::load_files(io::read_case_text(text, "case.toml")); }

std::string material(const char* kinematics, double spacing) {
  return fmt::format(
      "[lattice]\nspacing = {}\nkinematics = \"{}\"\n[material.rock]\nyoungs_modulus = {}\npoissons_ratio = {}\n"
      "density = 1000\n",
      spacing, kinematics, E, nu);
}

// Columns side by side without end, 2 x 2 x 8 cells of 1, that end `cut` above the lowest plane of nodes on a wall,
// with a traction on their upper face.
model::Definition column(double cut, const char* support, const char* traction, const char* rest = "") {
  return read(
      material("least-squares", 1) +
      fmt::format("[body]\nsize = [2, 2, 8]\nmaterial = \"rock\"\nsurface = \"cut\"\nperiodic = [\"x\", \"y\"]\n"
                  "[[region]]\nname = \"wall\"\nshape = \"half-space\"\npoint = [0, 0, {}]\nnormal = [0, 0, 1]\n"
                  "material = \"void\"\n[[boundary]]\nname = \"wall\"\nsurface = \"wall\"\nsupport = \"{}\"\n"
                  "[[load]]\nface = \"z-max\"\ntraction = {}\n[[probe]]\nname = \"top\"\nface = \"z-max\"\n"
                  "[[probe]]\nname = \"wall\"\nsurface = \"wall\"\nquantity = \"reaction\"\n",
                  cut, support, traction) +
      rest);
}

// A tube of radii 1/2 and 1 in plane strain within a ring that it slides on.
model::Definition tube(const std::string& rest, const char* kinematics = "rotational", double spacing = 0.05) {
  const auto cylinder = [](const char* name, double radius, const char* filling) {
    return fmt::format(
        "[[region]]\nname = \"{}\"\nshape = \"cylinder\"\nstart = [0.013, 0.017, -1]\nend = [0.013, 0.017, 2]\nradius "
        "= "
        "{}\nmaterial = \"{}\"\n",
        name, radius, filling);
  };
  return read(material(kinematics, spacing) +
              fmt::format("[body]\norigin = [-1.2, -1.2, 0]\nsize = [2.4, 2.4, {}]\nmaterial = \"void\"\nsurface = "
                          "\"cut\"\n",
                          2 * spacing) +
              cylinder("hull", 1, "rock") + cylinder("bore", 0.5, "void") +
              "[[boundary]]\nname = \"ring\"\nsurface = \"hull\"\nsupport = \"roller\"\n"
              "[[boundary]]\nface = \"z-min\"\nfix = [\"z\", \"rx\", \"ry\"]\n"
              "[[boundary]]\nface = \"z-max\"\nfix = [\"z\", \"rx\", \"ry\"]\n"
              "[[probe]]\nname = \"ring\"\nsurface = \"hull\"\nquantity = \"reaction\"\n"
              "[[probe]]\nname = \"torque\"\nsurface = \"hull\"\nquantity = \"moment\"\ncenter = [0.013, 0.017, 0]\n" +
              rest);
}

struct Ended {
  driver::Simulation simulation;
  driver::Outcome outcome;
  explicit Ended(const model::Definition& definition, const Communicator& communicator = Communicator::self())
      : simulation(definition, communicator), outcome(simulation.run({})) {}
  const mechanics::ProbeValue& probe(std::size_t p) const { return outcome.measurement.probes.at(p); }
};

// In uniform strain the surface stays where it is, wherever it cuts a cell: the spring gives way as the layer of
// material would that it leaves out (15.5). The upper face moves by t L/M, L the length of the column, M the modulus of
// the wave that strains so.
TEST(Supports, HoldAFlatSurfaceAtItsPlace) {
  int checked = 0;
  for (const double cut : {0.05, 0.3, 0.5, 0.75, 0.85, 0.95}) {
    const double length = 8 - cut;
    const Ended pressed(column(cut, "roller", "[0, 0, -1e6]"));
    EXPECT_NEAR(pressed.probe(0)[2] * wave_modulus / (-1e6 * length), 1, 1e-6) << cut;
    // The wall carries the load on 2 x 2.
    EXPECT_NEAR(pressed.probe(1)[2] / 4e6, 1, 1e-6) << cut;
    const Ended sheared(column(cut, "bonded", "[1e6, 0, 0]"));
    EXPECT_NEAR(sheared.probe(0)[0] * mu / (1e6 * length), 1, 1e-6) << cut;
    EXPECT_NEAR(sheared.probe(1)[0] / -4e6, 1, 1e-6) << cut;
    ++checked;
  }
  EXPECT_EQ(checked, 6);
}

TEST(Supports, RollerLetsSlide) {
  EXPECT_THAT([] { Ended(column(0.5, "roller", "[1e6, 0, 0]")); },
              ThrowsMessage<InputError>(HasSubstr("is free to move along x, y, and its loads do not balance")));
}

// u_r = A (r - 1/r) with u_r(1) = 0, and the pressure p at a = 1/2: A (2 (lambda + mu) + 2 mu/a^2) = -p.
TEST(Supports, TubeInARing) {
  const double p = 1e6, A = -p / (4 * mu + 2 * mu * 4);
  for (const char* kinematics : {"rotational", "least-squares"}) {
    const Ended run(
        tube("[[load]]\nsurface = \"bore\"\npressure = 1e6\n[[probe]]\nname = \"u\"\npoint = [0.75, 0, 0.05]\n",
             kinematics));
    const double x = 0.75 - 0.013, y = -0.017, r = std::hypot(x, y);
    const double u = (x * run.probe(2)[0] + y * run.probe(2)[1]) / r;
    EXPECT_NEAR(u / (A * (r - 1 / r)), 1, 0.005) << kinematics;
    // Nothing pushes it to a side or turns it; the ring carries 2 pi p/2 (on 0.1) in all directions.
    const double scale = p * 0.5 * 0.1;
    EXPECT_LT(std::hypot(run.probe(0)[0], run.probe(0)[1]), 1e-5 * scale);
    EXPECT_LT(std::abs(run.probe(1)[2]), 1e-5 * scale);
    EXPECT_EQ(run.outcome.solution->projected_motions, 1) << run.outcome.solution->free_motions;
    // The cycle's levels know the ring: without, nothing converges; measured: 25 and 25.
    EXPECT_LE(run.outcome.solution->iterations, 30);
    EXPECT_GE(run.outcome.solution->iterations, 5);
  }
}

TEST(Supports, CarryTheWeight) {
  model::Definition definition = tube("[[load]]\nacceleration = [3, -2, 0]\n");
  // Its middle is that of the cut cells, a little beside the axis: a roller would let it turn.
  definition.boundaries[0].support = model::BoundaryDefinition::Support::bonded;
  Ended run(definition);
  double mass = 0;
  const model::Model& model = run.simulation.model();
  lattice::for_each_owned(model.layout(), [&](auto, auto, auto, auto n) { mass += model.inertia.component(0)[n]; });
  EXPECT_NEAR(mass, 1000 * 0.1 * 0.75 * std::numbers::pi, 0.01 * mass);
  EXPECT_NEAR(run.probe(0)[0] / (-3 * mass), 1, 1e-6);
  EXPECT_NEAR(run.probe(0)[1] / (2 * mass), 1, 1e-6);
  // What a support stores counts as elastic energy: in equilibrium half the work of the weight.
  double work = 0;
  const auto& u = run.simulation.state().displacement;
  lattice::for_each_owned(model.layout(), [&](auto, auto, auto, auto n) {
    work += model.inertia.component(0)[n] * (3 * u.component(0)[n] - 2 * u.component(1)[n]);
  });
  EXPECT_NEAR(2 * run.outcome.measurement.balance.elastic_energy / work, 1, 1e-5);
  EXPECT_LT(run.outcome.measurement.balance.unbalanced_ratio(), 1e-6);
}

// A shaft of any direction turns freely in its bearing; it does not turn about another axis, nor move.
TEST(Supports, ShaftTurnsFreely) {
  const Vec3 axis = (1 / std::sqrt(1.66)) * Vec3{0.6, 0.3, 1.1};
  driver::Simulation simulation(
      read(material("rotational", 0.1) +
           "[body]\norigin = [-1.5, -1.5, -1.5]\nsize = [3, 3, 3]\nmaterial = \"void\"\nsurface = \"cut\"\n"
           "[[region]]\nname = \"shaft\"\nshape = \"cylinder\"\nstart = [-0.6, -0.3, -1.1]\nend = [0.6, 0.3, 1.1]\n"
           "radius = 0.7\nmaterial = \"rock\"\n[[boundary]]\nsurface = \"shaft\"\nsupport = \"roller\"\n"),
      Communicator::self());
  const model::Model& model = simulation.model();
  const auto energy = [&](const Vec3& turn, const Vec3& shift) {
    lattice::Field<double>& u = simulation.state().displacement;
    lattice::for_each_owned(model.layout(), [&](auto i, auto j, auto k, auto n) {
      const Vec3 at = shift + cross(turn, model.lattice.grid.position({i, j, k}));
      for (int c = 0; c < 3; ++c) {
        u.component(c)[n] = at[static_cast<std::size_t>(c)];
        u.component(3 + c)[n] = turn[static_cast<std::size_t>(c)];
      }
    });
    return simulation.measure().balance.elastic_energy;
  };
  // Springs of the ground alone resist; per area they are as stiff as some layers of a third of a cell.
  const double area = 2 * std::numbers::pi * 0.7 * 2 * std::sqrt(1.66), across = energy({}, {0.3, 1, 0});
  EXPECT_GT(across, 0.25 * area * wave_modulus / 0.1);
  EXPECT_LT(std::abs(energy(axis, {})), 1e-12 * across);
  EXPECT_GT(energy({1, 0, 0}, {}), 0.01 * across);
  EXPECT_GT(energy({}, axis), 0.1 * across);
  EXPECT_GT(model.lattice.ground.size(), 1000U);
}

// Motion under local damping ends where equilibrium is; the stable step is that of the springs too.
TEST(Supports, MotionEndsInEquilibrium) {
  const Ended still(column(0.5, "roller", "[0, 0, -1e6]"));
  const Ended moving(column(0.5, "roller", "[0, 0, -1e6]", "[analysis]\ntype = \"quasi-static\"\ntolerance = 1e-7\n"));
  EXPECT_NEAR(moving.probe(0)[2] / still.probe(0)[2], 1, 1e-4);
  EXPECT_NEAR(moving.probe(1)[2] / 4e6, 1, 1e-4);

  const auto limit = [](const model::Definition& definition) {
    const model::Model model = model::make_model(definition, Communicator::self());
    mechanics::ForceKernel kernel(model.lattice);
    return mechanics::stable_step(model, kernel).frequency;
  };
  model::Definition held = tube("", "least-squares"), loose = held;
  loose.boundaries.erase(loose.boundaries.begin());
  // Measured: 0.74.
  EXPECT_GT(limit(held), 0.65 * limit(loose));
  EXPECT_LT(limit(held), 0.95 * limit(loose));
}

TEST(Supports, SameBitsOnAnyRanks) {
  const std::string load = "[[load]]\nsurface = \"bore\"\npressure = 1e6\n[[load]]\nacceleration = [3, -2, 0]\n";
  const model::Definition still = tube(load);
  const model::Definition moving = tube(load + "[analysis]\ntype = \"dynamic\"\nduration = 4e-4\n");
  for (const model::Definition& definition : {still, moving}) {
    std::optional<Ended> alone(std::in_place, definition);
    const auto bits = test::bits_of(alone->simulation);
    EXPECT_NE(bits[0], 0);
    for (const int ranks : {2, 4}) {
      const auto group = test::first_ranks(ranks);
      if (!group) continue;
      Ended together(definition, *group);
      EXPECT_EQ(test::bits_of(together.simulation), bits) << ranks;
      EXPECT_EQ(together.probe(0), alone->probe(0)) << ranks;
      EXPECT_EQ(together.probe(1), alone->probe(1)) << ranks;
      EXPECT_EQ(together.outcome.measurement.balance.elastic_energy, alone->outcome.measurement.balance.elastic_energy);
    }
  }
}

TEST(Supports, BadInput) {
  const auto with = [](const std::string& boundary) {
    return [boundary] {
      model::make_model(tube("[[region]]\nname = \"far\"\nshape = \"sphere\"\ncenter = [0, 0, 0]\nradius = 0.2\n"
                             "material = \"void\"\n[[boundary]]\nname = \"wrong\"\n" +
                             boundary),
                        Communicator::self());
    };
  };
  EXPECT_THAT(
      with("face = \"x-min\"\nsupport = \"roller\"\n"),
      ThrowsMessage<InputError>(HasSubstr("boundary \"wrong\" is a support by a surface, but selects none; give it "
                                          "the surface of a region, or hold nodes by fix")));
  EXPECT_THAT(with("surface = \"far\"\nsupport = \"roller\"\n"),
              ThrowsMessage<InputError>(HasSubstr("the surface of region \"far\" is no surface of the body")));
  EXPECT_THAT(with("surface = \"hull\"\nsupport = \"slider\"\n"),
              ThrowsMessage<InputError>(HasSubstr("unknown support \"slider\"; allowed: \"roller\", \"bonded\"")));
}

}  // namespace
}  // namespace koshi
