#include "io/surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/log.h"
#include "io/closure.h"
#include "io/stl.h"
#include "koshi/error.h"

namespace koshi::io {
namespace {

// Places counted in cells, the centre of the first cell at 0. A float of the file that means a centre is taken for one.
Vec3 in_cells(const Vec3& corner, double scale, const lattice::Grid& grid) {
  Vec3 place{};
  for (std::size_t a = 0; a < 3; ++a) {
    const double x = (corner[a] * scale - grid.origin[a]) / grid.d - 0.5, near = std::round(x);
    place[a] = std::abs(x - near) < 1e-6 * (1 + std::abs(x)) ? near : x;
  }
  return place;
}

// On which side of the line from a to b (in the plane of y and z) the point lies: 1 left, -1 right. A point on the line
// is moved by an infinitesimal step along y, and by one still smaller along z, so that neighbouring triangles never
// claim it both, nor neither.
int side_of(const Vec3& a, const Vec3& b, double y, double z) {
  // The ends in one order always: the same rounding for both triangles at the edge.
  if (b < a) return -side_of(b, a, y, z);
  const double cross = (b[1] - a[1]) * (z - a[2]) - (b[2] - a[2]) * (y - a[1]);
  if (cross != 0) return cross > 0 ? 1 : -1;
  const double along_y = -(b[2] - a[2]), along_z = b[1] - a[1];
  const double step = along_y != 0 ? along_y : along_z;
  return step > 0 ? 1 : step < 0 ? -1 : 0;
}

/// Turns around each cell's centre that a surface makes, layer after layer of cells.
class Winding {
 public:
  Winding(std::vector<Triangle> triangles, const Int3& cells) : triangles_(std::move(triangles)), n_(cells) {
    order_.resize(triangles_.size());
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::sort(order_.begin(), order_.end(), [&](std::size_t a, std::size_t b) { return low(a, 2) < low(b, 2); });
  }

  /// The numbers of turns of layer k, x fastest; to be called for k = 0, 1, 2, ... With `count_only` crossings are
  /// counted whatever their direction.
  const std::vector<int>& layer(std::int64_t k, bool count_only) {
    turns_.assign(static_cast<std::size_t>(n_[0] * n_[1]), 0);
    while (next_ < order_.size() && low(order_[next_], 2) <= static_cast<double>(k)) active_.push_back(order_[next_++]);
    std::erase_if(active_, [&](std::size_t t) { return high(t, 2) < static_cast<double>(k); });
    for (const std::size_t t : active_) cross(triangles_[t], t, k, count_only);
    // What is entered at x stays so for all greater x.
    for (std::int64_t j = 0; j < n_[1]; ++j) {
      const auto row = turns_.begin() + j * n_[0];
      std::partial_sum(row, row + n_[0], row);
    }
    return turns_;
  }

 private:
  double low(std::size_t t, std::size_t axis) const {
    const Triangle& c = triangles_[t];
    return std::min({c[0][axis], c[1][axis], c[2][axis]});
  }
  double high(std::size_t t, std::size_t axis) const {
    const Triangle& c = triangles_[t];
    return std::max({c[0][axis], c[1][axis], c[2][axis]});
  }

  // Where lines along x through the centres of a layer cross a triangle: +1 where they enter, seen from its outside.
  void cross(const Triangle& c, std::size_t t, std::int64_t k, bool count_only) {
    const double z = static_cast<double>(k), most = static_cast<double>(n_[1] - 1);
    const double from = std::ceil(std::max(low(t, 1), 0.0)), to = std::floor(std::min(high(t, 1), most));
    for (double y = from; y <= to; ++y) {
      const int s0 = side_of(c[0], c[1], y, z), s1 = side_of(c[1], c[2], y, z), s2 = side_of(c[2], c[0], y, z);
      if (s0 != s1 || s1 != s2 || s0 == 0) continue;
      // Counter-clockwise in y and z: the outside is at greater x, a line along x leaves.
      const double uy = c[1][1] - c[0][1], uz = c[1][2] - c[0][2], vy = c[2][1] - c[0][1], vz = c[2][2] - c[0][2];
      const double area = uy * vz - uz * vy, py = y - c[0][1], pz = z - c[0][2];
      if (area == 0) continue;
      const double x =
          c[0][0] + ((py * vz - pz * vy) * (c[1][0] - c[0][0]) + (uy * pz - uz * py) * (c[2][0] - c[0][0])) / area;
      const double first = std::max(std::ceil(x), 0.0);
      if (!(first < static_cast<double>(n_[0]))) continue;
      turns_[static_cast<std::size_t>(y) * static_cast<std::size_t>(n_[0]) + static_cast<std::size_t>(first)] +=
          count_only ? 1 : -s0;
    }
  }

  std::vector<Triangle> triangles_;
  Int3 n_;
  std::vector<std::size_t> order_, active_;  ///< triangles by their lowest z; those that the layer may meet
  std::size_t next_ = 0;
  std::vector<int> turns_;
};

[[noreturn]] void fail_empty(const std::vector<Triangle>& triangles, double scale) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  Vec3 lo{infinite, infinite, infinite}, hi{-infinite, -infinite, -infinite};
  for (const Triangle& triangle : triangles)
    for (const Vec3& corner : triangle)
      for (std::size_t a = 0; a < 3; ++a) {
        lo[a] = std::min(lo[a], scale * corner[a]);
        hi[a] = std::max(hi[a], scale * corner[a]);
      }
  throw InputError(
      fmt::format("holds no cell's centre: it reaches from ({:.4g}, {:.4g}, {:.4g}) to ({:.4g}, {:.4g}, {:.4g}) m; "
                  "check scale and origin",
                  lo[0], lo[1], lo[2], hi[0], hi[1], hi[2]));
}

}  // namespace

std::vector<std::uint8_t> cells_inside(const std::filesystem::path& file, double scale, const lattice::Grid& grid) {
  std::vector<Triangle> triangles = read_stl(file);
  const Closure closure = closure_of(triangles);
  check_closed(closure);
  if (!closure.oriented)
    log_information(
        fmt::format("the triangles of {} do not all face outwards: what an odd number of its walls surround is inside",
                    file.native()));

  std::vector<Triangle> placed = triangles;
  for (Triangle& triangle : placed)
    for (Vec3& corner : triangle) corner = in_cells(corner, scale, grid);
  const Int3& n = grid.cells;
  Winding winding(std::move(placed), n);
  std::vector<std::uint8_t> inside(static_cast<std::size_t>(n[0] * n[1] * n[2]));
  std::int64_t count = 0, shared = 0;
  auto out = inside.begin();
  for (std::int64_t k = 0; k < n[2]; ++k)
    for (const int turns : winding.layer(k, !closure.oriented)) {
      *out = closure.oriented ? turns != 0 : turns % 2 != 0;
      count += *out++;
      shared += closure.oriented && std::abs(turns) > 1;
    }
  if (count == 0) fail_empty(triangles, scale);
  if (shared > 0)
    log_information(fmt::format("parts of {} overlap in {} cell{}; they are united", file.native(), shared,
                                shared == 1 ? "" : "s"));
  return inside;
}

}  // namespace koshi::io
