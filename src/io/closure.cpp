#include "io/closure.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "koshi/error.h"

namespace koshi::io {

Closure closure_of(const std::vector<Triangle>& triangles) {
  // Every edge with its ends in one order, equal ones beside each other.
  struct Edge {
    Vec3 from, to;
    int direction;
  };
  std::vector<Edge> edges;
  edges.reserve(3 * triangles.size());
  for (const Triangle& triangle : triangles)
    for (std::size_t v = 0; v < 3; ++v) {
      const Vec3 &a = triangle[v], &b = triangle[(v + 1) % 3];
      edges.push_back(a < b ? Edge{a, b, 1} : Edge{b, a, -1});
    }
  const auto ends = [](const Edge& edge) { return std::tie(edge.from, edge.to); };
  std::sort(edges.begin(), edges.end(), [&](const Edge& a, const Edge& b) { return ends(a) < ends(b); });

  Closure closure;
  for (auto first = edges.begin(); first != edges.end();) {
    int passes = 0, sum = 0;
    auto edge = first;
    for (; edge != edges.end() && ends(*edge) == ends(*first); ++edge, ++passes) sum += edge->direction;
    if (sum != 0) closure.oriented = false;
    if (passes % 2 != 0 && closure.open_edges++ == 0) closure.open_at = 0.5 * (first->from + first->to);
    first = edge;
  }
  return closure;
}

void check_closed(const Closure& closure) {
  if (closure.open_edges == 0) return;
  const Vec3& x = closure.open_at;
  throw InputError(fmt::format(
      "is no closed surface: {} of its edges belong to one triangle only, one near ({:.4g}, {:.4g}, {:.4g}) in the "
      "file's unit; close its holes",
      closure.open_edges, x[0], x[1], x[2]));
}

}  // namespace koshi::io
