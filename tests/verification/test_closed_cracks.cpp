// Cracks that are pressed together in equilibrium (theory, section 12, "Pressure across cracks"): they carry what the
// intact body carries, slide freely, open again, and the energies add up to the work while they do.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "driver/simulation.h"
#include "mechanics/face_springs.h"
#include "support/cases.h"

namespace koshi {
namespace {

using enum material::Kinematics;
const material::Elastic rock{30e9, 0.2, 2400};

struct Row {
  double factor, force;
  mechanics::Balance balance;
};

struct Followed {
  std::vector<Row> rows;
  driver::Outcome outcome;
  int turned = 0;  // times that a cell's faces parted or met between two events
};

// The force is that of the first probe along an axis.
Followed follow(const model::Definition& definition, std::size_t axis) {
  driver::Simulation simulation(definition, Communicator::world());
  Followed followed;
  driver::Observer observer;
  std::vector<int> before;  // by cell: 1 open, -1 closed, 0 without a crack
  observer.history = [&](const mechanics::Measurement& at, model::State& state) {
    followed.rows.push_back({at.balance.load_factor, at.probes[0][axis], at.balance});
    std::vector<int> faces;
    const model::Model& model = simulation.model();
    lattice::for_each_owned(model.layout(), [&](auto, auto, auto, auto n) {
      const Vec3 normal{state.crack.component(6)[n], state.crack.component(7)[n], state.crack.component(8)[n]};
      const double strain = mechanics::strain_along(model.lattice, state.displacement, n, normal);
      faces.push_back(state.crack.component(0)[n] == 0 ? 0 : strain > 0 ? 1 : -1);
    });
    for (std::size_t n = 0; n < before.size(); ++n) followed.turned += before[n] * faces[n] == -1 ? 1 : 0;
    before = faces;
  };
  followed.outcome = simulation.run(observer);
  return followed;
}

double gap(const Followed& followed) {
  double largest = 0;
  for (const Row& row : followed.rows)
    largest = std::max(largest, std::abs(row.balance.elastic_energy + row.balance.cracked - row.balance.given));
  return largest / followed.rows.back().balance.given;
}

// A block of cells of 5 mm that cracks at 3 MPa for 100 J/m^2, on smooth platens at its ends along an axis, of which
// the upper one moves by `motion` [m]; a plane through `center` with `normal` has cracked.
model::Definition column(const Int3& cells, std::size_t axis, double motion, const Vec3& center, const Vec3& normal,
                         double length) {
  model::Definition definition = test::block(cells, 0.005, rock);
  material::Fracture& fracture = definition.materials[0].fracture.emplace();
  fracture.tensile_strength = 3e6;
  fracture.fracture_energy = 100;
  model::CrackDefinition crack;
  crack.shape = model::CrackDefinition::Shape::rectangle;
  crack.center = center;
  crack.normal = normal;
  crack.along = cross(normal, {0, 0, 1});
  crack.length = length;
  crack.width = 1;
  definition.pre_cracks = {crack};
  const auto face = [axis](int side) { return static_cast<model::Face>(2 * static_cast<int>(axis) + side); };
  model::BoundaryDefinition push = test::fixed("push", face(1), {});
  push.displacement[axis] = motion;
  model::BoundaryDefinition point = test::fixed("point", face(0), {0, 1, 2});
  point.selection = {};
  point.selection.point = Vec3{0, 0, 0};
  model::BoundaryDefinition side = test::fixed("side", model::Face::z_min, {2});
  definition.boundaries = {test::fixed("wall", face(0), {axis}), push, side, point};
  definition.lattice.kinematics = least_squares;
  definition.probes = {
      test::probe("force", face(1), model::ProbeDefinition::Quantity::reaction, model::ProbeDefinition::Reduce::sum)};
  definition.analysis = {};
  definition.analysis.type = model::AnalysisDefinition::Type::statics;
  definition.analysis.tolerance = 1e-9;
  return definition;
}

// A column that is cracked right across and pushed carries E A u/L = 30 GPa 4 cm^2 1 um/40 mm = 300 N, as an intact one
// does, to the trace of springs; pulled, it carries that trace, 1e-6 of a layer: 8 layers, 8e-6 of the whole.
TEST(ClosedCracks, ColumnsCarryPressureAndNoTension) {
  for (const double motion : {-1e-6, 1e-6}) {
    const model::Definition definition = column({4, 8, 4}, 1, motion, {0.01, 0.0225, 0.01}, {0, 1, 0}, 1);
    const Followed seen = follow(definition, 1);
    ASSERT_GE(seen.rows.size(), 2u);
    const double stiffness = seen.rows[1].force / seen.rows[1].factor / 300;
    if (motion < 0) {
      EXPECT_NEAR(stiffness, -1, 2e-6);
      EXPECT_EQ(seen.outcome.path->reason, "nothing cracks any more");
      EXPECT_NEAR(seen.rows[1].balance.elastic_energy, 0.5 * 300 * 1e-6, 1e-9);
    } else {
      EXPECT_NEAR(stiffness, 8e-6, 2e-6);
    }
  }
}

// Stiffness of a column over that of an intact one at its first event.
double stiffness(const model::Definition& definition) {
  model::Definition whole = definition;
  whole.pre_cracks.clear();
  whole.analysis.events = 1;
  const Row with = follow(definition, 1).rows.at(1), without = follow(whole, 1).rows.at(1);
  return with.force / with.factor / (without.force / without.factor);
}

// A closed crack across the load is not there at all. An oblique one, of half-length a in a plate W x L, slides freely:
// at 45 degrees its shear tau = sigma/2 adds pi a^2 tau^2/E to the energy sigma^2 W L/(2 E), 8.7 % for a = 20 mm, W L =
// 60 mm x 120 mm: at most 0.92. The band of cells, sqrt(2) d wide, carries no stress along it either (3.9 % of the
// plate), and a crack over two thirds of the width sees more than sigma: 0.81 here.
TEST(ClosedCracks, SlideFreely) {
  model::Definition definition = column({12, 24, 1}, 1, -1e-6, {0.03, 0.06, 0.0025}, {1, 1, 0}, 0.04);
  definition.analysis.events = 1;
  EXPECT_NEAR(stiffness(definition), 0.815, 0.01);
  definition.pre_cracks[0].normal = {0, 1, 0};
  definition.pre_cracks[0].along = {1, 0, 0};
  EXPECT_NEAR(stiffness(definition), 1, 1e-6);
}

// A beam with a crack through the upper three quarters of its middle is bent until the rest breaks too: the lower part
// of the crack is open, the upper one presses, and as the crack comes up from below more and more of it opens. In every
// row elastic energy and cracks are the work.
TEST(ClosedCracks, EnergiesAddUpWhileFacesOpen) {
  model::Definition definition = column({33, 8, 1}, 1, 0, {0.0825, 0.025, 0.0025}, {1, 0, 0}, 0.03);
  definition.boundaries.clear();
  const auto line = [](const std::string& name, double from, double to, double y) {
    model::BoundaryDefinition boundary;
    boundary.name = name;
    boundary.selection.box = std::pair{Vec3{from, y, 0}, Vec3{to, y, 0.005}};
    return boundary;
  };
  model::BoundaryDefinition left = line("left", 0, 0, 0), right = line("right", 0.165, 0.165, 0),
                            load = line("load", 0.08, 0.085, 0.04);
  left.fix[0] = left.fix[1] = right.fix[1] = true;
  load.displacement[1] = -1e-3;
  definition.boundaries = {left, right, load, test::fixed("side", model::Face::z_min, {2})};
  definition.probes[0].selection = load.selection;
  definition.analysis.events = 60;
  const Followed seen = follow(definition, 1);
  EXPECT_GT(seen.rows.size(), 30u);
  EXPECT_GT(seen.rows.back().balance.cracked, 0);
  EXPECT_GE(seen.turned, 3) << gap(seen);
  EXPECT_LT(gap(seen), 1e-7);
}

}  // namespace
}  // namespace koshi
