// Closed surfaces from STL files as regions of cells.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

#include "koshi/input.h"
#include "support/program.h"
#include "support/temporary_directory.h"

namespace koshi::io {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

using Triangle = std::array<Vec3, 3>;

// Triangles of a closed surface over a rectangle of parameters, `rows` x `columns` quadrangles wide; those that shrink
// to a line are left out.
std::vector<Triangle> surface_of(int rows, int columns, const std::function<Vec3(int, int)>& point) {
  std::vector<Triangle> triangles;
  const auto add = [&](const Triangle& t) {
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) triangles.push_back(t);
  };
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      const Vec3 a = point(r, c), b = point(r + 1, c), x = point(r, (c + 1) % columns),
                 y = point(r + 1, (c + 1) % columns);
      add({a, b, y});
      add({a, y, x});
    }
  return triangles;
}

// A box as a surface of revolution with four sides: from one pole over the lower and upper corners to the other.
std::vector<Triangle> box_surface(const Vec3& lo, const Vec3& hi) {
  return surface_of(3, 4, [=](int row, int side) -> Vec3 {
    const double z = row < 2 ? lo[2] : hi[2];
    if (row == 0 || row == 3) return {0.5 * (lo[0] + hi[0]), 0.5 * (lo[1] + hi[1]), z};
    return {side == 0 || side == 3 ? lo[0] : hi[0], side < 2 ? lo[1] : hi[1], z};
  });
}

std::vector<Triangle> sphere_surface(const Vec3& center, double radius) {
  return surface_of(60, 60, [=](int row, int side) -> Vec3 {
    if (row == 0 || row == 60) return center + Vec3{0, 0, row == 0 ? -radius : radius};
    const double theta = std::numbers::pi * row / 60, phi = 2 * std::numbers::pi * side / 60;
    return center + radius * Vec3{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), -std::cos(theta)};
  });
}

class SurfaceTest : public testing::Test {
 protected:
  const test::TemporaryDirectory directory;
  void write_stl(const std::string& file, const std::vector<Triangle>& triangles) const {
    std::string text = "solid test\n";
    for (const Triangle& triangle : triangles) {
      text += "facet normal 0 0 0\nouter loop\n";
      for (const Vec3& x : triangle) text += fmt::format("vertex {:.9g} {:.9g} {:.9g}\n", x[0], x[1], x[2]);
      text += "endloop\nendfacet\n";
    }
    test::write_file(directory / file, text + "endsolid test\n");
  }
  // 8 x 6 x 10 cells of 1 mm, the corner at x = -1 mm; the region is all that is solid.
  model::Definition with_region(const std::string& file, const std::string& scale = "1 mm") const {
    return read_case_text(R"([lattice]
spacing = "1 mm"
[material.hard]
youngs_modulus = 1e9
poissons_ratio = 0.2
density = 1000
[body]
origin = ["-1 mm", 0, 0]
size = ["8 mm", "6 mm", "10 mm"]
material = "void"
[[region]]
shape = "stl"
file = ")" + file + R"("
scale = ")" + scale + R"("
material = "hard"
)",
                          (directory / "case.toml").native());
  }
  std::vector<std::uint8_t> inside(const std::string& file, const std::string& scale = "1 mm") const {
    return load_files(with_region(file, scale)).regions[0].inside;
  }
  std::int64_t count_inside(const std::string& file) const {
    const auto cells = inside(file);
    return std::accumulate(cells.begin(), cells.end(), std::int64_t{0});
  }
};

TEST_F(SurfaceTest, BoxHoldsTheCellsOfTheSameBoxRegion) {
  write_stl("box.stl", box_surface({0.8, 1.9, 2.6}, {4.2, 3.1, 8.4}));  // mm
  const auto cells = inside("box.stl");
  ASSERT_EQ(cells.size(), 8u * 6 * 10);
  // Cell (i, j, k) has its centre at (-0.5 + i, 0.5 + j, 0.5 + k) mm.
  int count = 0;
  for (int k = 0; k < 10; ++k)
    for (int j = 0; j < 6; ++j)
      for (int i = 0; i < 8; ++i) {
        const double x = -0.5 + i, y = 0.5 + j, z = 0.5 + k;
        const bool in = x > 0.8 && x < 4.2 && y > 1.9 && y < 3.1 && z > 2.6 && z < 8.4;
        count += in;
        ASSERT_EQ(cells[static_cast<std::size_t>(i + 8 * (j + 6 * k))], in) << i << ' ' << j << ' ' << k;
      }
  EXPECT_EQ(count, 3 * 1 * 5);  // x: 1.5 2.5 3.5; y: 2.5; z: 3.5 ... 7.5
}

TEST_F(SurfaceTest, SphereHasItsVolumeInAnotherUnit) {
  write_stl("sphere.stl", sphere_surface({0.3, 0.3, 0.5}, 0.25));  // cm
  const auto cells = inside("sphere.stl", "1 cm");
  // 4/3 pi 2.5^3 = 65.4 cells of 1 mm^3; counted on centres x = -0.5 + i etc. with |x - c| < 2.5 mm.
  int count = 0;
  for (int k = 0; k < 10; ++k)
    for (int j = 0; j < 6; ++j)
      for (int i = 0; i < 8; ++i) count += std::hypot(-0.5 + i - 3, 0.5 + j - 3, 0.5 + k - 5) < 2.49;
  EXPECT_EQ(std::accumulate(cells.begin(), cells.end(), 0), count);
  EXPECT_GT(count, 50);
}

TEST_F(SurfaceTest, OpenSurfaceAndOthersAreRefused) {
  std::vector<Triangle> box = box_surface({1, 1, 1}, {4, 4, 4});
  box.erase(box.begin() + 3);
  write_stl("open.stl", box);
  EXPECT_THAT([&] { load_files(with_region("open.stl")); },
              ThrowsMessage<InputError>(testing::AllOf(HasSubstr("case.toml:13:8: error:"),
                                                       HasSubstr("is no closed surface: 3 of its edges"),
                                                       HasSubstr("one near ("))));
  test::write_file(directory / "text.stl", "hello");
  EXPECT_THAT([&] { load_files(with_region("text.stl")); }, ThrowsMessage<InputError>(HasSubstr("text.stl\" ")));
  EXPECT_THAT([&] { load_files(with_region("none.stl")); }, ThrowsMessage<InputError>(HasSubstr("cannot be opened")));
  write_stl("box.stl", box_surface({1, 1, 1}, {4, 4, 4}));
  EXPECT_THAT([&] { load_files(with_region("box.stl", "1 m")); },
              ThrowsMessage<InputError>(HasSubstr(
                  "holds no cell's centre: it reaches from (1, 1, 1) to (4, 4, 4) m; check scale and origin")));
}

std::vector<Triangle> operator+(std::vector<Triangle> a, const std::vector<Triangle>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// Turns a surface inside out.
std::vector<Triangle> reversed(std::vector<Triangle> triangles) {
  for (Triangle& triangle : triangles) std::swap(triangle[0], triangle[1]);
  return triangles;
}

// Cells of 1 mm with centres at x = -0.5 + i, y = 0.5 + j, z = 0.5 + k.
TEST_F(SurfaceTest, PartsThatOverlapAreUnited) {
  const auto a = box_surface({0.9, 0.9, 0.9}, {4.1, 4.1, 4.1}), b = box_surface({2.1, 2.1, 2.1}, {6.1, 5.1, 6.1});
  write_stl("two.stl", a + b);
  // a: x 1.5 to 3.5, likewise y and z: 27. b: x 2.5 to 5.5, y 2.5 to 4.5, z 2.5 to 5.5: 4 * 3 * 4 = 48. Both: 2^3 = 8.
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  EXPECT_EQ(count_inside("two.stl"), 27 + 48 - 8);
  const std::string said = testing::internal::GetCapturedStdout() + testing::internal::GetCapturedStderr();
  EXPECT_THAT(said, HasSubstr("two.stl overlap in 8 cells; they are united"));
  // Inside out, the whole is the same body.
  write_stl("out.stl", reversed(a + b));
  EXPECT_EQ(count_inside("out.stl"), 27 + 48 - 8);
  // Each triangle twice.
  write_stl("twice.stl", a + a);
  EXPECT_EQ(count_inside("twice.stl"), 27);
}

TEST_F(SurfaceTest, WallsThatFaceInwardsEncloseACavity) {
  const auto outer = box_surface({0.9, 0.9, 0.9}, {6.1, 5.1, 6.1}),
             inner = box_surface({2.1, 2.1, 2.1}, {4.1, 4.1, 4.1});
  // Outer: 5 * 4 * 5 = 100 centres; cavity 2^3.
  write_stl("cavity.stl", outer + reversed(inner));
  EXPECT_EQ(count_inside("cavity.stl"), 100 - 8);
  // The same wall facing outwards is a part within a part.
  write_stl("within.stl", outer + inner);
  EXPECT_EQ(count_inside("within.stl"), 100);
}

TEST_F(SurfaceTest, TrianglesThatDoNotAllFaceOutwardsCountByCrossings) {
  auto box = box_surface({0.9, 0.9, 0.9}, {4.1, 4.1, 4.1});
  for (const std::size_t t : {0U, 3U, 7U}) std::swap(box[t][0], box[t][1]);
  write_stl("mixed.stl", box);
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  EXPECT_EQ(count_inside("mixed.stl"), 27);
  const std::string said = testing::internal::GetCapturedStdout() + testing::internal::GetCapturedStderr();
  EXPECT_THAT(said, HasSubstr("do not all face outwards"));
}

// Faces and edges through centres: those on the lower faces are inside, those on the upper ones are not, on every axis.
TEST_F(SurfaceTest, CentresOnTheSurfaceFollowOneRuleOnAllAxes) {
  write_stl("on.stl", box_surface({0.5, 1.5, 2.5}, {3.5, 4.5, 5.5}));
  const auto cells = inside("on.stl");
  int count = 0;
  for (int k = 0; k < 10; ++k)
    for (int j = 0; j < 6; ++j)
      for (int i = 0; i < 8; ++i) {
        const bool in = i >= 1 && i < 4 && j >= 1 && j < 4 && k >= 2 && k < 5;
        count += in;
        ASSERT_EQ(cells[static_cast<std::size_t>(i + 8 * (j + 6 * k))], in) << i << ' ' << j << ' ' << k;
      }
  EXPECT_EQ(count, 27);
}

TEST_F(SurfaceTest, BinaryFilesAreWholeOrRefused) {
  const auto box = box_surface({0.9, 0.9, 0.9}, {4.1, 4.1, 4.1});
  std::string bytes = "solid is what some binary files begin with";
  bytes.resize(80, ' ');
  const auto add = [&](const auto value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
  add(static_cast<std::uint32_t>(box.size()));
  for (const Triangle& triangle : box) {
    for (int zero = 0; zero < 3; ++zero) add(0.0F);
    for (const Vec3& corner : triangle)
      for (const double x : corner) add(static_cast<float>(x));
    add(std::uint16_t{0});
  }
  test::write_file(directory / "box.stl", bytes);
  EXPECT_EQ(count_inside("box.stl"), 27);
  const auto refused = [&](const std::string& content, const std::string& message) {
    test::write_file(directory / "bad.stl", content);
    EXPECT_THAT([&] { inside("bad.stl"); }, ThrowsMessage<InputError>(HasSubstr(message)));
  };
  const std::string unnamed = "other" + bytes.substr(5);
  refused(unnamed.substr(0, unnamed.size() - 1), fmt::format("is no STL file: {} triangles make", box.size()));
  refused(unnamed + "x", fmt::format("is no STL file: {} triangles make", box.size()));
  std::string nowhere = bytes;
  nowhere.replace(84 + 12, 4, "\xff\xff\xff\x7f");
  refused(nowhere, "has a corner that is no place, at triangle 1");
  refused("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0\nvertex", "has \"vertex\" where a number is expected");
  refused("solid a\nendsolid a\n", "holds no triangles");
}

}  // namespace
}  // namespace koshi::io
