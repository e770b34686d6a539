#include "model/shapes.h"

namespace koshi::model {

double Primitive::distance(const Vec3& x) const {
  const Vec3 r = x - point;
  switch (kind) {
    case Kind::plane:
      return dot(r, axis);
    case Kind::sphere:
      return norm(r) - radius;
    case Kind::bar:
      return norm(cross(r, axis)) - radius;
  }
  return 0;
}

std::vector<Primitive> primitives_of(const RegionDefinition& region) {
  using Shape = RegionDefinition::Shape;
  using Kind = Primitive::Kind;
  switch (region.shape) {
    case Shape::box: {
      std::vector<Primitive> sides;
      for (std::size_t a = 0; a < 3; ++a) {
        Vec3 up{};
        up[a] = 1;
        sides.push_back({Kind::plane, region.min, -1.0 * up, 0});
        sides.push_back({Kind::plane, region.max, up, 0});
      }
      return sides;
    }
    case Shape::sphere:
      return {{Kind::sphere, region.center, {}, region.radius}};
    case Shape::cylinder: {
      const Vec3 along = region.end - region.start;
      const Vec3 axis = (1 / norm(along)) * along;
      return {{Kind::bar, region.start, axis, region.radius},
              {Kind::plane, region.start, -1.0 * axis, 0},
              {Kind::plane, region.end, axis, 0}};
    }
    case Shape::half_space:
      return {{Kind::plane, region.point, (1 / norm(region.normal)) * region.normal, 0}};
    case Shape::stl:
      break;
  }
  return {};
}

}  // namespace koshi::model
