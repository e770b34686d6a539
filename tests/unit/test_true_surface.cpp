// The true surface of bodies whose cells are cut, as reports show it.
#include "report/true_surface.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "koshi/input.h"
#include "model/regions.h"

namespace koshi::report {
namespace {

// A body of 12^3 cells of 1/6 in [-1, 1]^3.
struct Body {
  model::Definition definition;
  lattice::Grid grid;
  Surface surface;
  std::vector<MovedPoint> moved;
  std::vector<Vec3> points;  // on the true surface

  Body(const std::string& regions, const std::string& material, std::int64_t most_points = 1'000'000)
      : definition(io::load_files(io::read_case_text(fmt::format(R"([lattice]
spacing = 0.16666666666666666
[material.rock]
youngs_modulus = 1e9
poissons_ratio = 0.2
density = 1
[body]
origin = [-1, -1, -1]
size = [2, 2, 2]
material = "{}"
surface = "cut"
{})",
                                                                 material, regions),
                                                     "case.toml"))),
        grid(model::make_grid(definition)) {
    const auto material_of = model::material_of_cells(definition, grid);
    std::vector<std::uint16_t> cells;
    for (std::int64_t k = 0; k < grid.cells[2]; ++k)
      for (std::int64_t j = 0; j < grid.cells[1]; ++j)
        for (std::int64_t i = 0; i < grid.cells[0]; ++i) cells.push_back(material_of({i, j, k}));
    surface = extract_surface(grid.cells, cells, {most_points, 0});
    moved = true_surface(definition, grid, surface);
    for (const std::int64_t point : surface.points) points.push_back(position(point));
    for (const MovedPoint& point : moved) points[static_cast<std::size_t>(point.point)] = point.at;
  }

  Vec3 position(std::int64_t point) const {
    const Int3 n{grid.cells[0] + 1, grid.cells[1] + 1, grid.cells[2] + 1};
    return grid.position({point % n[0], point / n[0] % n[1], point / n[0] / n[1]});
  }

  // By the divergence theorem, each quad as two triangles.
  double volume() const {
    double six_fold = 0;
    for (const auto& quad : surface.quads) {
      std::array<Vec3, 4> x;
      for (std::size_t c = 0; c < 4; ++c) x[c] = points[static_cast<std::size_t>(quad[c])];
      six_fold += dot(x[0], cross(x[1], x[2])) + dot(x[0], cross(x[2], x[3]));
    }
    return six_fold / 6;
  }

  // The places of points are those of their weights: values of a linear field are kept.
  void expect_linear_fields_are_kept() const {
    for (const MovedPoint& point : moved) {
      Vec3 at{};
      for (std::size_t c = 0; c < 8; ++c) at = at + static_cast<double>(point.weights[c]) * position(point.nodes[c]);
      EXPECT_LT(norm(at - point.at), 1e-5);
    }
  }
};

TEST(TrueSurface, OfABallLiesOnIt) {
  const Body body(R"([[region]]
shape = "sphere"
center = [0.03, 0.01, -0.02]
radius = 0.8
material = "rock"
)",
                  "void");
  // The facets lie a few thousandths of a cell inside the ball; every point of the cells' surface lies off it.
  EXPECT_EQ(body.moved.size(), body.surface.points.size());
  EXPECT_GT(body.moved.size(), 400U);
  for (const Vec3& x : body.points) EXPECT_NEAR(norm(x - Vec3{0.03, 0.01, -0.02}), 0.8, 0.005 / 6);
  // Quads with their corners on the ball cut off less than edge^2/8 radius of it, with edges of up to 1.7 cells: 1.6 %
  // of the radius, in the mean of the volume less than 4 %. The surface of the cells holds half as much again as the
  // ball.
  const double ball = 4.0 / 3 * std::numbers::pi * std::pow(0.8, 3);
  EXPECT_LT(body.volume(), ball);
  EXPECT_GT(body.volume(), 0.96 * ball);
  body.expect_linear_fields_are_kept();
}

TEST(TrueSurface, OfATubeEndsWithTheGridAndKeepsItsFlatFaces) {
  const Body body(R"([[region]]
shape = "cylinder"
start = [0.02, 0.03, -1]
end = [0.02, 0.03, 1]
radius = 0.9
material = "rock"
[[region]]
shape = "cylinder"
start = [0.02, 0.03, -2]
end = [0.02, 0.03, 2]
radius = 0.43
material = "void"
)",
                  "void");
  int rims = 0, walls = 0, flat = 0;
  for (std::size_t p = 0; p < body.points.size(); ++p) {
    const Vec3& x = body.points[p];
    const Vec3 cells = body.position(body.surface.points[p]);
    const double r = std::hypot(x[0] - 0.02, x[1] - 0.03);
    // Nothing moves along the axis, so that the ends stay flat.
    EXPECT_NEAR(x[2], cells[2], 1e-12);
    const bool on_wall = std::abs(r - 0.9) < 0.005 / 6 || std::abs(r - 0.43) < 0.005 / 6;
    const bool at_end = std::abs(std::abs(cells[2]) - 1) < 1e-12;
    EXPECT_TRUE(on_wall || (at_end && r > 0.43 && r < 0.9)) << r;
    if (on_wall) ++(at_end ? rims : walls);
    if (x == cells) ++flat;
  }
  EXPECT_GT(rims, 60);
  EXPECT_GT(walls, 400);
  EXPECT_GT(flat, 60);
  const double tube = 2 * std::numbers::pi * (0.9 * 0.9 - 0.43 * 0.43);
  EXPECT_NEAR(body.volume(), tube, 0.02 * tube);
  body.expect_linear_fields_are_kept();
}

TEST(TrueSurface, EndsAtEdgesBetweenRegions) {
  // A bore across a block: the rim lies on both surfaces.
  const Body body(R"([[region]]
shape = "box"
min = [-0.7, -0.71, -0.72]
max = [0.71, 0.72, 0.7]
material = "rock"
[[region]]
shape = "cylinder"
start = [0.02, 0.03, -2]
end = [0.02, 0.03, 2]
radius = 0.4
material = "void"
)",
                  "void");
  int in_bore = 0, on_ends = 0, rim = 0;
  for (const Vec3& x : body.points) {
    const double r = std::hypot(x[0] - 0.02, x[1] - 0.03);
    const bool at_end = x[2] > 0.7 - 1e-9 || x[2] < -0.72 + 1e-9;
    // The end of a face is known to a sixteenth of a cell across, an eighth along the diagonal.
    EXPECT_GT(r, 0.4 - 1.0 / 6 / 8);
    if (std::abs(r - 0.4) < 1.0 / 6 / 8) ++(at_end ? rim : in_bore);
    if (at_end && r > 0.45) ++on_ends;
  }
  EXPECT_GT(in_bore, 100);
  EXPECT_GT(rim, 30);
  EXPECT_GT(on_ends, 100);
  const double block = 1.41 * 1.43 * 1.42 - std::numbers::pi * 0.16 * 1.42;
  EXPECT_NEAR(body.volume(), block, 0.02 * block);
}

TEST(TrueSurface, OfAThinnedSurfaceLiesOnItToo) {
  const Body body(R"([[region]]
shape = "sphere"
center = [0, 0, 0]
radius = 0.85
material = "rock"
)",
                  "void", 200);
  EXPECT_GT(body.surface.stride, 1);
  EXPECT_GT(body.moved.size(), 50U);
  for (const MovedPoint& point : body.moved) EXPECT_NEAR(norm(point.at), 0.85, 0.005 / 6);
}

TEST(TrueSurface, FacesThatNoRegionCutStay) {
  // A block whose faces lie between cells, and a half-space far from most of them.
  const Body body(R"([[region]]
shape = "half-space"
point = [0.58, 0, 0]
normal = [-1, 0, 0]
material = "void"
)",
                  "rock");
  // Only the points of the layer of cells that the plane cuts: 13 x 13 nodes at x = 2/3.
  EXPECT_EQ(body.moved.size(), 169U);
  for (const MovedPoint& point : body.moved) EXPECT_NEAR(point.at[0], 0.58, 1e-12);
  EXPECT_NEAR(body.volume(), 1.58 * 2 * 2, 1e-9);
}

}  // namespace
}  // namespace koshi::report
