// Loads that vary in space and time: resultant and moment against integrals of linear fields.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>

#include "koshi/input.h"
#include "koshi/model.h"
#include "mechanics/loads.h"
#include "support/temporary_directory.h"

namespace koshi::model {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

// A block of 8 x 6 x 4 cells of 1/4 with its corner at (1, 2, 3) and density 2.
Definition block(const std::string& rest, const std::string& body = "material = \"rock\"") {
  return io::load_files(io::read_case_text(fmt::format(R"([lattice]
spacing = 0.25
[material.rock]
youngs_modulus = 1e9
poissons_ratio = 0.2
density = 2
[body]
origin = [1, 2, 3]
size = [2, 1.5, 1]
{}
)",
                                                       body) +
                                               rest,
                                           "case.toml"));
}

struct Sums {
  Vec3 force{}, moment{};  // about the origin
  std::size_t count = 0;
};

Sums sums(const Model& model, const std::vector<NodeForce>& forces) {
  std::map<std::int64_t, Vec3> position;
  lattice::for_each_owned(model.layout(), [&](auto i, auto j, auto k, auto n) {
    position[n] = model.lattice.grid.position(model.layout().global({i, j, k}));
  });
  Sums result;
  for (const NodeForce& f : forces) {
    result.force = result.force + f.force;
    result.moment = result.moment + cross(position.at(f.node), f.force);
    ++result.count;
  }
  return result;
}

Sums sums(const Definition& definition) {
  const Model model = make_model(definition, Communicator::world());
  return sums(model, model.loads.at(0).forces);
}

void expect_near(const Vec3& value, const Vec3& exact, double tolerance) {
  for (std::size_t a = 0; a < 3; ++a) EXPECT_NEAR(value[a], exact[a], tolerance) << "xyz"[a];
}

TEST(ProfiledLoads, LinearPressureOnAFace) {
  // p = 10 (3 - 2y + z) on x = 3, over y in [2, 3.5], z in [3, 4]. With Y = y - 2.75, Z = z - 3.5 it is 10 (1 - 2Y +
  // Z): the force is -10 * 1.5 along x. About the middle (3, 2.75, 3.5), My = int Z Fx, Mz = -int Y Fx with int Z^2
  // = 1.5/12, int Y^2 = 1.5^3/12.
  const Sums found = sums(block("[[load]]\nface = \"x-max\"\npressure = 10\nprofile = \"3 - 2*y + z\"\n"));
  EXPECT_EQ(found.count, 7u * 5);
  const Vec3 force{-15, 0, 0};
  expect_near(found.force, force, 1e-12);
  const Vec3 about_middle{0, -10 * 1.5 / 12, -2 * 10 * 3.375 / 12};
  expect_near(found.moment, about_middle + cross({3, 2.75, 3.5}, force), 1e-11);
}

TEST(ProfiledLoads, TractionOnPartOfAFace) {
  // t = (1, 2, 3) x on z = 4, x in [1, 2], y in [2, 3]: int x = 1.5; moment int r x t x.
  const Sums found =
      sums(block("[[load]]\nbox = {min = [1, 2, 4], max = [2, 3, 4]}\ntraction = [1, 2, 3]\nprofile = \"x\"\n"));
  EXPECT_EQ(found.count, 25u);
  expect_near(found.force, {1.5, 3, 4.5}, 1e-12);
  // int x r = (int x^2, int x y, int x z) = (7/3, 1.5 * 2.5, 1.5 * 4).
  expect_near(found.moment, cross({7.0 / 3, 3.75, 6}, {1, 2, 3}), 1e-11);
}

TEST(ProfiledLoads, BodyForce) {
  // rho int x dV = 2 * 2 * 3 (volume 3, mean x 2) along z, also where the formula is a constant.
  expect_near(sums(block("[[load]]\nacceleration = [0, 0, -10]\nprofile = \"x\"\n")).force, {0, 0, -120}, 1e-11);
  expect_near(sums(block("[[load]]\nacceleration = [0, 0, -10]\nprofile = \"0.5\"\n")).force, {0, 0, -30}, 1e-11);
}

TEST(ProfiledLoads, BuoyancyOfABodyFromAFile) {
  // A regular octahedron of radius r in a liquid: force -grad(p) V with V = 4/3 r^3, through the middle, exactly, since
  // its faces are flat.
  const test::TemporaryDirectory directory;
  const Vec3 c{2.011, 2.723, 3.517};
  const double r = 0.41;
  std::ofstream file(directory / "part.stl");
  file << "solid s\n";
  for (int corner = 0; corner < 8; ++corner) {
    Vec3 x{c}, y{c}, z{c};
    x[0] += corner & 1 ? -r : r;
    y[1] += corner & 2 ? -r : r;
    z[2] += corner & 4 ? -r : r;
    if (((corner & 1) + (corner >> 1 & 1) + (corner >> 2)) % 2 != 0) std::swap(y, z);
    file << "facet normal 0 0 0\nouter loop\n";
    for (const Vec3& v : {x, y, z}) file << fmt::format("vertex {:.17g} {:.17g} {:.17g}\n", v[0], v[1], v[2]);
    file << "endloop\nendfacet\n";
  }
  file << "endsolid s\n";
  file.close();
  const std::string region =
      fmt::format("[[region]]\nname = \"part\"\nshape = \"stl\"\nscale = 1\nmaterial = \"rock\"\nfile = \"{}\"\n",
                  (directory / "part.stl").native());
  const Sums found =
      sums(block(region + "[[load]]\nsurface = \"part\"\npressure = 2\nprofile = \"50 + x - 2*y + 3*z\"\n",
                 "material = \"void\"\nsurface = \"cut\""));
  EXPECT_GT(found.count, 70u);
  const Vec3 exact = -2 * 4.0 / 3 * r * r * r * Vec3{1, -2, 3};
  expect_near(found.force, exact, 1e-10);
  expect_near(found.moment, cross(c, exact), 1e-9);
}

TEST(ProfiledLoads, FollowTime) {
  const std::string dynamic = "[analysis]\ntype = \"dynamic\"\nduration = 1\n";
  const Model model = make_model(
      block("[[load]]\nface = \"x-max\"\npressure = 10\nprofile = \"t * y\"\nhistory = [[0, 1], [4, 3]]\n" + dynamic),
      Communicator::world());
  ASSERT_TRUE(model.loads[0].profiled);
  mechanics::LoadRows rows(model);
  const lattice::Layout& layout = model.layout();
  for (const double t : {0.0, 2.0, 1.0}) {
    rows.set_time(t);
    double force = 0;
    std::vector<double> row(3 * static_cast<std::size_t>(layout.owned()[0]));
    for (std::int64_t k = 0; k < layout.owned()[2]; ++k)
      for (std::int64_t j = 0; j < layout.owned()[1]; ++j) {
        std::fill(row.begin(), row.end(), 0);
        const std::array<double*, 3> force_row{row.data(), row.data() + layout.owned()[0],
                                               row.data() + 2 * layout.owned()[0]};
        rows.add(j, k, force_row.data());
        for (std::int64_t i = 0; i < layout.owned()[0]; ++i) force += force_row[0][i];
      }
    // -10 t int y dA times the history, 1 + t/2, with int y = 1.5 * 2.75.
    EXPECT_NEAR(force, -10 * t * 1.5 * 2.75 * (1 + t / 2), 1e-11) << t;
  }
  EXPECT_FALSE(
      make_model(block("[[load]]\nface = \"x-max\"\npressure = 10\nprofile = \"y\"\n" + dynamic), Communicator::world())
          .loads[0]
          .profiled);
}

TEST(ProfiledLoads, OnAPeriodicBody) {
  // Periodic across y: p = y on z = 4 is that of places inside the box, so int y dA = 2 * 1.5 * 2.75.
  const Sums found = sums(
      block("[[load]]\nface = \"z-max\"\npressure = 1\nprofile = \"y\"\n", "material = \"rock\"\nperiodic = [\"y\"]"));
  expect_near(found.force, {0, 0, -8.25}, 1e-12);
}

TEST(ProfiledLoads, Refused) {
  const auto refused = [](const std::string& load, const std::string& message) {
    EXPECT_THAT([&] { make_model(block("[[load]]\n" + load), Communicator::world()); },
                ThrowsMessage<InputError>(HasSubstr(message)))
        << load;
  };
  refused("face = \"x-max\"\npressure = 1\nprofile = \"2 + depth\"\n",
          "case.toml:14:11: error: the formula has the unknown name or sign \"depth\" at character 5");
  refused("face = \"x-max\"\nforce = [1, 0, 0]\nprofile = \"x\"\n",
          "\"profile\" has no meaning here; it goes with a load with traction, pressure or acceleration");
  refused("face = \"x-max\"\npressure = 1\nprofile = \"t\"\n",
          "has a profile that depends on t, but only motion knows the time");
  refused("face = \"x-max\"\npressure = 1\nprofile = \"1/(x - 3)\"\n",
          "case.toml:14:11: error: the formula \"1/(x - 3)\" has no finite value at x = 3, y = 2.05283, z = 3.05283 m, "
          "where "
          "load \"load 1\" acts");
  refused("face = \"x-max\"\npressure = 1\nprofile = \"sqrt(y - 3)\"\n", "has no finite value at x = 3, y = 2.05283");
  refused("face = \"x-max\"\npressure = 1\nprofile = 3\n", "profile is the number 3; expected a text in quotes");
  refused("box = {min = [1.1, 2.1, 3.1], max = [2, 3, 3.9]}\npressure = 1\nprofile = \"x\"\n",
          "selects no surface of the body to act on");
}

}  // namespace
}  // namespace koshi::model
