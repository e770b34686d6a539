// Cracks from the start, the catalogue of events and the surface of cracks, on bodies and lists small enough to count.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "driver/crack_events.h"
#include "driver/crack_surface.h"
#include "koshi/input.h"
#include "koshi/model.h"

namespace koshi {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

const std::string block = R"([lattice]
spacing = 1
[body]
size = [10, 10, 4]
material = "rock"
[material.rock]
youngs_modulus = 1e9
poissons_ratio = 0.2
density = 1000
fracture = { tensile_strength = 1e4, fracture_energy = 100 }
[material.steel]
youngs_modulus = 1e9
poissons_ratio = 0.2
density = 1000
[[region]]
shape = "box"
min = [0, 0, 3]
max = [10, 10, 4]
material = "steel"
[[crack]]
name = "flaw"
shape = "rectangle"
center = [5, 2, 1.5]
normal = [2, 0, 0]
along = [0, 1, 0]
length = 4
width = 3
[[probe]]
name = "wall"
face = "x-min"
quantity = "reaction"
[analysis]
type = "dynamic"
duration = 1
)";

model::Definition read(const std::vector<std::string>& overrides = {}) {
  return io::read_case_text(block, "case.toml", overrides);
}

// Global cells that begin as cracked, of a model on one rank.
std::vector<Int3> cracked(const model::Definition& definition) {
  const model::Model model = model::make_model(definition, Communicator::world());
  const model::State state(model);
  std::vector<Int3> cells;
  lattice::for_each_owned(model.layout(), [&](auto i, auto j, auto k, auto n) {
    EXPECT_TRUE(state.crack.component(0)[n] == 0 || state.crack.component(0)[n] == 1);
    if (state.crack.component(0)[n] == 1) cells.push_back({i, j, k});
  });
  return cells;
}

// The plane x = 5 lies between two layers of cells, of which one cracks: y = 0 to 4, z = 0 to 3.
TEST(PreCracks, RectanglesCrackOneLayer) {
  const auto cells = cracked(read());
  ASSERT_EQ(cells.size(), 4u * 3);
  for (const Int3& cell : cells) {
    EXPECT_EQ(cell[0], 5);
    EXPECT_LT(cell[1], 4);
    EXPECT_LT(cell[2], 3);
  }
  // In the middle of a layer, and turned by a quarter, it is the same number.
  EXPECT_EQ(cracked(read({"crack.0.center=[5.5, 2, 1.5]"})), cells);
  EXPECT_EQ(cracked(read({"crack.0.along=[1, 0, 1]", "crack.0.length=3", "crack.0.width=4"})), cells);
}

// A plane at 45 degrees cuts 2 cells for each cell's side along x; discs hold the centres within their radius.
TEST(PreCracks, ObliquePlanesCrackAllTheyCut) {
  const auto cells =
      cracked(read({"crack=[{center=[5, 5, 1.5], normal=[1, 1, 0], shape='rectangle', along=[0, 0, 1], length=3, "
                    "width=100}]"}));
  std::array<int, 10> columns{};
  for (const Int3& cell : cells) {
    ++columns[static_cast<std::size_t>(cell[0])];
    // Cell (i, j) has its centre at i + j + 1 - 10 over the plane, times 1/sqrt 2.
    EXPECT_TRUE(cell[0] + cell[1] == 9 || cell[0] + cell[1] == 10);
  }
  for (std::size_t i = 0; i < 10; ++i) EXPECT_EQ(columns[i], i == 0 ? 3 : 6) << i;
  // Of a quarter, centres at (0.5, 0.5), (0.5, 1.5), (1.5, 0.5) and (1.5, 1.5).
  EXPECT_EQ(cracked(read({"crack=[{center=[5, 5, 2], normal=[0, 0, -1], radius=2.2}]"})).size(), 16u);
}

TEST(PreCracks, WhatIsWrongIsSaidAtTheKey) {
  const std::vector<std::pair<std::string, std::string>> wrong{
      {"crack.0.center=[50, 2, 1.5]", "case.toml:20:1: error: crack \"flaw\" cuts no cell of the body"},
      {"crack.0.width=5", "crack \"flaw\" cuts cells of material \"steel\", which cannot crack; give that a fracture"},
      {"crack.0.normal=[0, 0, 0]", "normal is zero; it needs a direction such as [1, 0, 0]"},
      {"crack.0.along=[1, 0, 0]", "along is zero or points across the plane; it needs a direction in the plane"},
      {"crack.0.length=-1", "length is -1 m; it must lie between"},
      {"crack.0.shape=square", "unknown shape \"square\"; allowed: \"disc\", \"rectangle\""},
      {"crack.0.radius=1", "\"radius\" has no meaning here; it goes with shape \"disc\""},
      {"material.rock.fracture.law=none", "cracks belong to materials that crack, and there is none"},
      {"analysis.stop_when={}", "stop_when has no condition; give a probe with below"},
      {"analysis.stop_when={probe='wall'}", "stop_when has no \"below\""},
      {"analysis.stop_when={probe='wall', below=1}", "below is 1; it must be above 0 and below 1"},
      {"analysis.stop_when={probe='wal', below=0.5}",
       "there is no probe \"wal\" of a reaction; did you mean \"wall\"?"},
      {"analysis.stop_when={below=0.5}", "\"below\" has no meaning here; it goes with a probe"},
      {"analysis.stop_when={face='x'}", "unknown face \"x\""},
      {"analysis={type='modes', stop_when={face='x-max'}}", "\"stop_when\" has no meaning here"},
      {"analysis={type='static', stop_when={face='x-max', after=1}}",
       "a static analysis without steps has no time that could pass before; leave after out"},
  };
  for (const auto& [override_text, message] : wrong)
    EXPECT_THAT([&] { model::make_model(read({override_text}), Communicator::world()); },
                ThrowsMessage<InputError>(HasSubstr(message)))
        << override_text;
  EXPECT_THAT(
      [&] {
        read({"crack=[]", "material.rock.fracture.law=none", "analysis.stop_when={face='x-max'}"});
      },
      ThrowsMessage<InputError>(HasSubstr("no material can crack, so that no crack reaches a face")));
  EXPECT_THAT(
      [&] {
        read({"crack=[]", "material.rock.fracture.law=none", "analysis={type='static', stop_when={face='x-max'}}"});
      },
      ThrowsMessage<InputError>(HasSubstr("no material can crack, and such an equilibrium is found at once")));
  EXPECT_THAT(
      [&] {
        read({"crack=[]", "material.rock.fracture.law=none", "output.crack_surface=true"});
      },
      ThrowsMessage<InputError>(HasSubstr("a surface of cracks needs a material that cracks")));
}

driver::CrackedCell cell(const Int3& at, double moment, double energy = 1, double shear = 0) {
  return {.number = at[0] + 10 * (at[1] + 10 * at[2]), .moment = moment, .damage = 1, .energy = energy, .shear = shear};
}

// Cells that share a corner and part within 2 s hang together: a chain whose ends are 3 s apart is one event. The same
// places later are another, and so is a cell that touches none, or one that lies across a border that is not joined.
TEST(Events, GroupCellsInSpaceAndTime) {
  lattice::Grid grid{{10, 10, 4}, 2, {}, {}};
  std::vector<driver::CrackedCell> cells{cell({0, 0, 0}, 5, 8, 1), cell({1, 1, 0}, 6.5, 1), cell({2, 1, 1}, 8, 3),
                                         cell({3, 1, 1}, 11, 4),   cell({9, 1, 0}, 6, 2),   cell({5, 5, 2}, 0, 9)};
  std::ranges::sort(cells, {}, &driver::CrackedCell::number);
  const auto within_two = [](double a, double b) { return std::abs(a - b) <= 2; };
  auto events = driver::crack_events(grid, cells, within_two);
  ASSERT_EQ(events.size(), 3u);  // the cell that was cracked before the run is none
  EXPECT_EQ(events[0].time, 5);
  EXPECT_EQ(events[0].duration, 3);
  EXPECT_EQ(events[0].cells, 3);
  EXPECT_EQ(events[0].energy, 12);
  EXPECT_NEAR(events[0].shear, 1 / 3.0, 1e-15);
  // Centres at 1, 3, 5; 1, 3, 3; 1, 1, 3.
  EXPECT_NEAR(norm(events[0].place - Vec3{3, 7 / 3.0, 5 / 3.0}), 0, 1e-14);
  EXPECT_EQ(events[1].time, 6);
  EXPECT_EQ(events[1].cells, 1);
  EXPECT_EQ(events[2].time, 11);
  grid.periodic[0] = true;
  events = driver::crack_events(grid, cells, within_two);
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].cells, 4);
}

// In equilibrium moments are numbers of events. The factors rise to 2 at event 2 and not beyond until 5: events 2, 3
// and 4 are one rise, 1 and 5 are others, so that a chain of neighbours at 2, 4, 5 and one at 1 are three events.
TEST(Events, GroupCellsOfOneRise) {
  const std::vector<double> factors{0, 1, 2, 1.5, 2, 2.5, 2.1};
  const auto together = driver::within_one_rise(factors);
  for (int a = 1; a <= 6; ++a)
    for (int b = 1; b <= 6; ++b) {
      const auto rise = [](int e) { return e == 1 ? 1 : e < 5 ? 2 : 3; };
      EXPECT_EQ(together(a, b), rise(a) == rise(b)) << a << " " << b;
    }
  const lattice::Grid grid{{10, 10, 4}, 2, {}, {}};
  const std::vector<driver::CrackedCell> cells{cell({0, 0, 0}, 1), cell({1, 0, 0}, 2), cell({2, 0, 0}, 4, 3),
                                               cell({3, 0, 0}, 5)};
  const auto events = driver::crack_events(grid, cells, together);
  const auto rows = driver::event_rows(events, factors);
  ASSERT_EQ(rows.size(), 3u);
  const auto columns = driver::event_columns(factors);
  EXPECT_EQ(columns[0], "event [1]");
  EXPECT_EQ(columns[2], "load factor [1]");
  // Number, last number, factor; the middle event has its place between its two cells.
  for (const auto& row : rows) EXPECT_EQ(row.size(), columns.size());
  EXPECT_THAT(std::vector(rows[1].begin(), rows[1].begin() + 8), testing::ElementsAre(2, 4, 2, 4, 1, 1, 4, 2));
  EXPECT_EQ(rows[0][0], 1);
  EXPECT_EQ(rows[2][2], 2.5);
  EXPECT_EQ(driver::event_columns({})[0], "time [s]");
}

// Magnitudes by log10 E = 4.8 + 1.5 M. Energies of 20 events at 1, 10, 100 ... of the least: the mean lies by 1/1.5
// times the mean of the exponents above the least magnitude.
TEST(Events, MagnitudesAndBValue) {
  EXPECT_NEAR((driver::CrackEvent{.energy = std::pow(10, 4.8 + 1.5 * 2)}.magnitude()), 2, 1e-12);
  std::vector<driver::CrackEvent> events;
  for (int e = 0; e < 20; ++e) events.push_back({.energy = std::pow(10, e % 4)});
  auto summary = driver::events_summary(events);
  EXPECT_EQ(summary["count"], 20);
  EXPECT_NEAR(summary["energy"].get<double>(), 5 * 1111, 1e-9);
  EXPECT_NEAR(summary["largest_magnitude"].get<double>(), (3 - 4.8) / 1.5, 1e-12);
  EXPECT_NEAR(summary["b_value"].get<double>(), std::numbers::log10e / (1.5 / 1.5), 1e-12);
  events.pop_back();
  EXPECT_TRUE(driver::events_summary(events)["b_value"].is_null());
}

double area(const std::vector<Vec3>& polygon) {
  Vec3 sum{};
  for (std::size_t p = 1; p + 1 < polygon.size(); ++p)
    sum = sum + cross(polygon[p] - polygon[0], polygon[p + 1] - polygon[0]);
  return 0.5 * norm(sum);
}

// Cuts of a cell of side 2 about (1, 1, 1): a square, a rectangle sqrt 2 times as long, and the regular hexagon across
// the body diagonal with sides of half a face's diagonal, 6 sqrt(3)/4 s^2.
TEST(CrackSurface, CutsOfACell) {
  const double s = 1 / std::numbers::sqrt2, t = std::numbers::inv_sqrt3;
  for (const auto& [n, corners, size] : {std::tuple{Vec3{0, 1, 0}, 4u, 4.0},
                                         {Vec3{0, s, -s}, 4u, 4 * std::numbers::sqrt2},
                                         {Vec3{t, -t, t}, 6u, 1.5 * std::numbers::sqrt3 * 2}}) {
    const auto polygon = driver::cut_of_cell({1, 1, 1}, 2, n);
    EXPECT_EQ(polygon.size(), corners);
    EXPECT_NEAR(area(polygon), size, 1e-12);
    for (const Vec3& corner : polygon) {
      EXPECT_NEAR(dot(corner - Vec3{1, 1, 1}, n), 0, 1e-14);
      for (const double x : corner) EXPECT_TRUE(x > -1e-8 && x < 2 + 1e-8);
    }
  }
}

}  // namespace
}  // namespace koshi
