// How the triangles of a surface join.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "koshi/vector3.h"

namespace koshi::io {

using Triangle = std::array<Vec3, 3>;

/// How the triangles join.
struct Closure {
  std::int64_t open_edges = 0;  ///< that an odd number of triangles share
  Vec3 open_at{};               ///< the middle of one of them
  bool oriented = true;         ///< each edge is passed as often in one direction as in the other
};

Closure closure_of(const std::vector<Triangle>& triangles);

/// Throws an InputError without a place that names an open edge.
void check_closed(const Closure& closure);

}  // namespace koshi::io
