// The bodies that regions and selections are made of, as intersections of half-spaces, balls and round bars.
#pragma once

#include <vector>

#include "koshi/definition.h"

namespace koshi::model {

/// One smooth surface and the side of it that is inside.
struct Primitive {
  enum class Kind { plane, sphere, bar };
  Kind kind = Kind::plane;
  Vec3 point{};       ///< on the plane, the centre, or on the axis [m]
  Vec3 axis{};        ///< the plane's normal that points out, the bar's direction; length 1
  double radius = 0;  ///< [m]

  /// Distance from the surface [m], negative inside.
  double distance(const Vec3& x) const;
};

/// What a region is the intersection of; nothing for one from a file.
std::vector<Primitive> primitives_of(const RegionDefinition& region);

}  // namespace koshi::model
