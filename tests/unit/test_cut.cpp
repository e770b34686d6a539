// Cells that surfaces cut: volumes, masses, and loads on surfaces.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "koshi/input.h"
#include "koshi/model.h"
#include "mechanics/stable_step.h"
#include "model/cut.h"
#include "model/plane_cut.h"
#include "model/region_surface.h"
#include "model/regions.h"
#include "support/temporary_directory.h"

namespace koshi::model {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

// A body of 16^3 cells of 1/8 in [-1, 1]^3 with density 1; `rest` are regions, loads and so on.
Definition cube(const std::string& rest, const std::string& material = "void",
                const std::string& kinematics = "rotational") {
  return io::load_files(io::read_case_text(fmt::format(R"([lattice]
spacing = 0.125
kinematics = "{}"
[material.rock]
youngs_modulus = 1e9
poissons_ratio = 0.2
density = 1
[body]
origin = [-1, -1, -1]
size = [2, 2, 2]
material = "{}"
surface = "cut"
)",
                                                       kinematics, material) +
                                               rest,
                                           "case.toml"));
}

double mass_of(const Model& model) {
  double mass = 0;
  lattice::for_each_owned(model.layout(), [&](auto, auto, auto, auto n) { mass += model.inertia.component(0)[n]; });
  return mass;
}

TEST(PlaneCut, AgreesWithTheVolumesOfSimpleBodies) {
  // A corner cut off by x + y + z = a from it has the volume a^3/6 up to a = 1; the middle halves the cube.
  for (const double a : {0.1, 0.5, 1.0}) EXPECT_NEAR(part_below({1, 1, 1}, a - 1.5), a * a * a / 6, 1e-12);
  EXPECT_NEAR(part_below({3, -2, 0.7}, 0), 0.5, 1e-12);
  // Across an axis it is the distance; along a diagonal of a face a triangle.
  EXPECT_NEAR(part_below({0, 2, 0}, 0.5), 0.75, 1e-12);
  EXPECT_NEAR(part_below({1, 1, 0}, -0.5), 0.125, 1e-12);
  EXPECT_EQ(part_below({1, 2, 3}, 3.1), 1);
  EXPECT_EQ(part_below({1, 2, 3}, -3.1), 0);
  for (const double part : {0.01, 0.3, 0.77})
    EXPECT_NEAR(part_below({1, -0.4, 0.2}, offset_of_part({1, -0.4, 0.2}, part)), part, 1e-12);
}

TEST(Cut, BallHasItsVolumeAndMass) {
  const Model model = make_model(cube("[[region]]\nshape = \"sphere\"\ncenter = [0.03, 0.01, -0.02]\nradius = 0.9\n"
                                      "material = \"rock\"\n"),
                                 Communicator::world());
  // 4/3 pi 0.9^3 = 3.05363; slivers below 2 % are counted apart.
  const double exact = 4.0 / 3 * std::numbers::pi * 0.729, cell = 1.0 / 512;
  ASSERT_TRUE(model.cut.has_value());
  EXPECT_NEAR(model.volume() + cell * model.cut->left_out, exact, 1e-5 * exact);
  EXPECT_GT(model.cut->left_out, 0);
  EXPECT_NEAR(mass_of(model), model.volume(), 1e-6);
  // The surface of 10.18 meets about 1.5 cells for each 1/64 of area.
  EXPECT_GT(model.cut->count, 650);
  EXPECT_LT(model.cut->count, 1300);
}

TEST(Cut, ShapesAlongCellsAreThoseOfStairs) {
  const std::string box =
      "[[region]]\nshape = \"box\"\nmin = [-0.5, -0.5, -1]\nmax = [0.5, 0.25, 1]\nmaterial = \"rock\"\n";
  const Model cut = make_model(cube(box), Communicator::world());
  EXPECT_EQ(cut.cut->count, 0);
  // 8 x 6 x 16 cells.
  EXPECT_EQ(cut.cell_count, 768);
  EXPECT_EQ(cut.cut->volume, 768);
}

TEST(Cut, TubeAndObliquePlaneAndHoleInImage) {
  // A tube along z through the whole box, then cut by a plane through its middle: half of pi (0.8^2 - 0.45^2) 2.
  const std::string tube = R"([[region]]
shape = "cylinder"
start = [0, 0, -1]
end = [0, 0, 1]
radius = 0.8
material = "rock"
[[region]]
shape = "cylinder"
start = [0, 0, -1]
end = [0, 0, 1]
radius = 0.45
material = "void"
[[region]]
shape = "half-space"
point = [0, 0, 0]
normal = [1, 2, 3]
material = "void"
)";
  const Model model = make_model(cube(tube), Communicator::world());
  const double exact = std::numbers::pi * (0.64 - 0.2025);
  EXPECT_NEAR(model.volume() + model.cut->left_out / 512, exact, 2e-3 * exact);
}

TEST(Cut, StableStepStays) {
  for (const char* kinematics : {"rotational", "least-squares"}) {
    const auto limit = [&](const std::string& regions, const char* material) {
      const Model model = make_model(cube(regions, material, kinematics), Communicator::world());
      mechanics::ForceKernel kernel(model.lattice);
      return mechanics::stable_step(model, kernel).frequency;
    };
    const double whole = limit("", "rock");
    const double ball = limit(
        "[[region]]\nshape = \"sphere\"\ncenter = [0.03, 0.01, -0.02]\nradius = 0.9\nmaterial = \"rock\"\n", "void");
    EXPECT_GT(ball, 0.7 * whole) << kinematics;
    EXPECT_LT(ball, 1.5 * whole) << kinematics;
  }
}

// Resultant and moment of the nodal forces.
std::pair<Vec3, Vec3> sums(const Model& model) {
  Vec3 force{}, moment{};
  lattice::for_each_owned(model.layout(), [&](auto i, auto j, auto k, auto n) {
    for (const NodeForce& f : model.loads[0].forces) {
      if (f.node != n) continue;
      force = force + f.force;
      moment = moment + cross(model.lattice.grid.position(model.layout().global({i, j, k})), f.force);
    }
  });
  return {force, moment};
}

const std::string hole = R"([[region]]
name = "hole"
shape = "sphere"
center = [0.03, 0.01, -0.02]
radius = 0.55
material = "void"
)";

TEST(SurfaceLoad, PressureInACavityHasNoResultant) {
  const Model model =
      make_model(cube(hole + "[[load]]\nsurface = \"hole\"\npressure = 3\n", "rock"), Communicator::world());
  const auto [force, moment] = sums(model);
  double size = 0;
  Vec3 center{0.03, 0.01, -0.02};
  double outward = 0;
  for (const NodeForce& f : model.loads[0].forces) size += norm(f.force);
  // Of the order of the load, 3 * 4 pi 0.55^2 = 11.4.
  EXPECT_GT(size, 9);
  EXPECT_LT(norm(force), 1e-12 * size);
  EXPECT_LT(norm(moment), 1e-12 * size);
  // Pressure pushes away from the cavity's middle: the virial is p 3 V = 3 * 3 * 4/3 pi 0.55^3 = 6.2720.
  lattice::for_each_owned(model.layout(), [&](auto i, auto j, auto k, auto n) {
    for (const NodeForce& f : model.loads[0].forces)
      if (f.node == n) outward += dot(f.force, model.lattice.grid.position(model.layout().global({i, j, k})) - center);
  });
  EXPECT_NEAR(outward, 6.2720, 0.002 * 6.2720);
}

TEST(SurfaceLoad, ForceAndPartOfASurface) {
  // The upper half of the cavity carries a total force, whose moment about the origin is that of a force through the
  // centroid of the half sphere's surface, R/2 above the centre.
  const std::string rest = hole + R"([[selection]]
name = "wall"
surface = "hole"
[[selection]]
name = "upper"
half_space = {point = [0, 0, -0.02], normal = [0, 0, -1]}
[[selection]]
name = "upper wall"
intersection = ["wall", "upper"]
[[load]]
selection = "upper wall"
force = [5, 0, 2]
)";
  const Model model = make_model(cube(rest, "rock"), Communicator::world());
  const auto [force, moment] = sums(model);
  EXPECT_NEAR(force[0], 5, 5e-12);
  EXPECT_NEAR(force[1], 0, 5e-12);
  EXPECT_NEAR(force[2], 2, 5e-12);
  const Vec3 exact = cross({0.03, 0.01, -0.02 + 0.275}, {5, 0, 2});
  for (std::size_t a = 0; a < 3; ++a) EXPECT_NEAR(moment[a], exact[a], 0.02) << a;
}

TEST(SurfaceLoad, SupportsTakeTheCornersOfCutCells) {
  const Model model =
      make_model(cube(hole + "[[boundary]]\nsurface = \"hole\"\nfix = [\"x\"]\n", "rock"), Communicator::world());
  ASSERT_GT(model.motions.size(), 400u);
  const lattice::Grid& grid = model.lattice.grid;
  lattice::for_each_owned(model.layout(), [&](auto i, auto j, auto k, auto n) {
    for (const PrescribedMotion& m : model.motions) {
      if (m.node != n) continue;
      const double r = norm(grid.position(model.layout().global({i, j, k})) - Vec3{0.03, 0.01, -0.02});
      // Within a cell's diagonal and what a sliver moves.
      EXPECT_LT(std::abs(r - 0.55), 2 * std::sqrt(3.0) / 8);
    }
  });
}

TEST(SurfaceLoad, WhatTheBodyHasNot) {
  const auto refused = [](const std::string& rest, const std::string& message) {
    EXPECT_THAT([&] { make_model(cube(rest, "rock"), Communicator::world()); },
                ThrowsMessage<InputError>(HasSubstr(message)));
  };
  refused(
      "[[region]]\nname = \"far\"\nshape = \"sphere\"\ncenter = [5, 0, 0]\nradius = 1\nmaterial = \"void\"\n"
      "[[load]]\nsurface = \"far\"\npressure = 1\n",
      "case.toml:19:1: error: load \"load 1\" selects no surface of the body");
  refused(hole + "[[load]]\nsurface = \"hull\"\npressure = 1\n", "there is no region \"hull\"; known: \"hole\"");
  refused(hole + "[[selection]]\nname = \"a\"\nunion = [\"a\"]\n", "there is no selection before this one \"a\"");
}

// Triangles of a regular octahedron of radius r, or of two that overlap.
void write_octahedra(const std::filesystem::path& path, const std::vector<Vec3>& centers, bool inward = false) {
  std::ofstream file(path);
  file << "solid s\n";
  for (const Vec3& c : centers)
    for (int corner = 0; corner < 8; ++corner) {
      Vec3 x{c}, y{c}, z{c};
      const double r = 0.7;
      x[0] += corner & 1 ? -r : r;
      y[1] += corner & 2 ? -r : r;
      z[2] += corner & 4 ? -r : r;
      const bool odd = ((corner & 1) + (corner >> 1 & 1) + (corner >> 2)) % 2 != 0;
      if (odd != inward) std::swap(y, z);
      file << "facet normal 0 0 0\nouter loop\n";
      for (const Vec3& v : {x, y, z}) file << fmt::format("vertex {:.17g} {:.17g} {:.17g}\n", v[0], v[1], v[2]);
      file << "endloop\nendfacet\n";
    }
  file << "endsolid s\n";
}

TEST(Cut, SurfacesFromFiles) {
  const test::TemporaryDirectory directory;
  const std::string region =
      fmt::format("[[region]]\nname = \"part\"\nshape = \"stl\"\nscale = 1\nmaterial = \"rock\"\nfile = \"{}\"\n",
                  (directory / "part.stl").native());
  for (const bool inward : {false, true}) {
    write_octahedra(directory / "part.stl", {{0.011, 0.023, 0.017}}, inward);
    const Model model =
        make_model(cube(region + "[[load]]\nsurface = \"part\"\npressure = 2\n"), Communicator::world());
    // 4/3 r^3 = 0.457333, exact but for slivers.
    EXPECT_NEAR(model.volume() + model.cut->left_out / 512, 4.0 / 3 * 0.343, 1e-6);
    const auto [force, moment] = sums(model);
    EXPECT_LT(norm(force), 1e-11);
    EXPECT_LT(norm(moment), 1e-11);
    EXPECT_GT(model.loads[0].forces.size(), 200u);
  }
  write_octahedra(directory / "part.stl", {{0.011, 0.023, 0.017}, {0.2, 0.1, 0.05}});
  EXPECT_THAT([&] { cube(region); }, ThrowsMessage<InputError>(HasSubstr("crosses or overlaps itself near (")));
}

}  // namespace
}  // namespace koshi::model
