// The surface of voxel bodies: closed, facing outwards, of the right volume, thinned without losing thin parts.
#include "report/surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace koshi::report {
namespace {

constexpr SurfaceLimits everything{1'000'000, 1'000'000};

// One byte per cell, from a predicate of (i, j, k).
template <class F>
std::vector<std::uint16_t> cells_where(const Int3& cells, F&& solid) {
  std::vector<std::uint16_t> material;
  for (std::int64_t k = 0; k < cells[2]; ++k)
    for (std::int64_t j = 0; j < cells[1]; ++j)
      for (std::int64_t i = 0; i < cells[0]; ++i) material.push_back(solid(i, j, k) ? 2 : 0);
  return material;
}

Int3 place(std::int64_t index, const Int3& size) {
  return {index % size[0], index / size[0] % size[1], index / size[0] / size[1]};
}

Vec3 position(const Surface& surface, std::int32_t point, const Int3& cells) {
  const Int3 at = place(surface.points[static_cast<std::size_t>(point)], {cells[0] + 1, cells[1] + 1, cells[2] + 1});
  return {static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2])};
}

// Volume inside by the divergence theorem, 1/3 of the integral of x . n, each quad as two triangles; positive only when
// the quads face outwards.
double volume(const Surface& surface, const Int3& cells) {
  double six_fold = 0;
  for (const auto& quad : surface.quads) {
    const Vec3 a = position(surface, quad[0], cells), b = position(surface, quad[1], cells);
    const Vec3 c = position(surface, quad[2], cells), d = position(surface, quad[3], cells);
    six_fold += dot(a, cross(b, c)) + dot(a, cross(c, d));
  }
  return six_fold / 6;
}

// Whether every edge is run through as often in one direction as in the other.
bool is_closed(const Surface& surface) {
  std::map<std::pair<std::int32_t, std::int32_t>, int> balance;
  for (const auto& quad : surface.quads)
    for (std::size_t side = 0; side < 4; ++side) {
      const std::int32_t a = quad[side], b = quad[(side + 1) % 4];
      balance[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  return std::ranges::all_of(balance, [](const auto& edge) { return edge.second == 0; });
}

TEST(ReportSurface, BoxHasItsSixFaces) {
  const Int3 cells{3, 4, 5};
  const auto material = cells_where(cells, [](auto, auto, auto) { return true; });
  const Surface surface = extract_surface(cells, material, {1'000'000, 0});
  EXPECT_EQ(surface.quads.size(), 2U * (3 * 4 + 4 * 5 + 5 * 3));
  // All nodes but the inner ones: 4 x 5 x 6 - 2 x 3 x 4.
  EXPECT_EQ(surface.points.size(), 120U - 24U);
  EXPECT_EQ(surface.body_points, 96);
  EXPECT_EQ(surface.cells.size(), 60U - 1 * 2 * 3);
  EXPECT_FALSE(surface.has_interior);
  EXPECT_TRUE(is_closed(surface));
  EXPECT_DOUBLE_EQ(volume(surface, cells), 60);
}

TEST(ReportSurface, InteriorAddsTheInnerNodesAndCells) {
  const Int3 cells{3, 4, 5};
  const auto material = cells_where(cells, [](auto, auto, auto) { return true; });
  const Surface surface = extract_surface(cells, material, {1'000'000, 120});
  EXPECT_TRUE(surface.has_interior);
  EXPECT_EQ(std::set(surface.points.begin(), surface.points.end()).size(), 120U);
  EXPECT_EQ(surface.points.size(), 120U);
  EXPECT_EQ(std::set(surface.cells.begin(), surface.cells.end()).size(), 60U);
  EXPECT_FALSE(extract_surface(cells, material, {1'000'000, 119}).has_interior);
}

TEST(ReportSurface, HolesAndTouchingCellsAreClosed) {
  // A cavity at (2, 2, 2), a notch, and a cell that touches the body along an edge only.
  const Int3 cells{6, 5, 5};
  const auto solid = [](auto i, auto j, auto k) {
    if (i == 5) return j == 4 && k == 0;
    return !(i == 2 && j == 2 && k == 2) && !(i == 4 && j == 4 && k < 2);
  };
  const auto material = cells_where(cells, solid);
  const Surface surface = extract_surface(cells, material, everything);
  const auto count = std::count(material.begin(), material.end(), 2);
  EXPECT_EQ(count, 5 * 5 * 5 - 1 - 2 + 1);
  EXPECT_TRUE(is_closed(surface));
  EXPECT_DOUBLE_EQ(volume(surface, cells), static_cast<double>(count));
  EXPECT_EQ(surface.cells.size(), static_cast<std::size_t>(count));
  // The cell behind each quad is solid and has the quad's four corners.
  for (std::size_t q = 0; q < surface.quads.size(); ++q) {
    const Int3 cell = place(surface.cells[static_cast<std::size_t>(surface.quad_cell[q])], cells);
    ASSERT_TRUE(solid(cell[0], cell[1], cell[2]));
    for (const std::int32_t point : surface.quads[q])
      for (std::size_t a = 0; a < 3; ++a) {
        const double beside = position(surface, point, cells)[a] - static_cast<double>(cell[a]);
        ASSERT_TRUE(beside == 0 || beside == 1);
      }
  }
}

TEST(ReportSurface, ThinningStaysBelowTheLimitAndOnTheBody) {
  // A ball of radius 20 cells with a plate one cell thick beside it.
  const Int3 cells{50, 41, 41};
  const auto solid = [](auto i, auto j, auto k) {
    return i == 48 || (i - 20) * (i - 20) + (j - 20) * (j - 20) + (k - 20) * (k - 20) <= 400;
  };
  const auto material = cells_where(cells, solid);
  const Surface whole = extract_surface(cells, material, everything);
  const Surface thin = extract_surface(cells, material, {2000, 1'000'000});
  EXPECT_EQ(whole.stride, 1);
  EXPECT_GT(thin.stride, 1);
  EXPECT_EQ(thin.body_points, whole.body_points);
  EXPECT_LE(thin.points.size(), 2000U);
  EXPECT_GE(thin.points.size(), 500U);
  EXPECT_FALSE(thin.has_interior);
  EXPECT_TRUE(is_closed(thin));
  // Blocks with any solid cell are solid, so the body grows by less than a block's side all around: r = 20 + 4.
  EXPECT_GT(volume(thin, cells), 0.9 * volume(whole, cells));
  EXPECT_LT(volume(thin, cells), std::pow(24.0 / 20.0, 3) * volume(whole, cells));

  // Every point is a node of a solid cell, every cell is solid, and the plate is still there.
  int on_plate = 0;
  for (std::size_t p = 0; p < thin.points.size(); ++p) {
    const Vec3 at = position(thin, static_cast<std::int32_t>(p), cells);
    bool touches = false;
    for (int corner = 0; corner < 8; ++corner) {
      const Int3 cell{static_cast<std::int64_t>(at[0]) - (corner & 1),
                      static_cast<std::int64_t>(at[1]) - (corner >> 1 & 1),
                      static_cast<std::int64_t>(at[2]) - (corner >> 2)};
      bool inside = true;
      for (std::size_t a = 0; a < 3; ++a) inside = inside && cell[a] >= 0 && cell[a] < cells[a];
      touches = touches || (inside && solid(cell[0], cell[1], cell[2]));
    }
    ASSERT_TRUE(touches);
    if (at[0] == 48 || at[0] == 49) ++on_plate;
  }
  EXPECT_GT(on_plate, 100);
  for (const std::int64_t cell : thin.cells) {
    const Int3 at = place(cell, cells);
    ASSERT_TRUE(solid(at[0], at[1], at[2]));
  }
}

}  // namespace
}  // namespace koshi::report
