#include "mechanics/face_springs.h"

#include <algorithm>
#include <array>
#include <utility>

#include "mechanics/corners.h"

namespace koshi::mechanics {
namespace {

constexpr std::array<double, 2> side{-1, 1};

// Corner a of a cell as a vector of signs.
Vec3 signs_of(int a) { return {side[a & 1], side[a >> 1 & 1], side[a >> 2]}; }

}  // namespace

// With the strain of (2.5), eps = sym(sum_s u(s) s)/(4 d), it is sum_s (n.u(s)) (n.s)/(4 d).
double strain_along(const model::SpringLattice& body, const lattice::Field<double>& u, std::int64_t cell,
                    const Vec3& normal) {
  double strain = 0;
  for (int a = 0; a < 8; ++a) {
    const std::int64_t node = cell + body.layout.offset(corner(a));
    const Vec3 at{u.component(0)[node], u.component(1)[node], u.component(2)[node]};
    strain += dot(normal, at) * dot(normal, signs_of(a));
  }
  return strain / (4 * body.grid.d);
}

FaceSprings::FaceSprings(const model::SpringLattice& body, lattice::Field<double>& force)
    : body_(body), force_(force), forces_(body.layout, force) {}

void FaceSprings::clear() {
  for (const FaceSpring& spring : springs_) forces_.clear(spring.cell);
}

void FaceSprings::set(std::vector<FaceSpring> springs) {
  clear();
  springs_ = std::move(springs);
  forces_.forget();
  for (const FaceSpring& spring : springs_) forces_.reach(spring.cell);
}

// The stress t n n in a cell gives its corner s the force -d^2/4 t (n.s) n.
void FaceSprings::update(const lattice::Field<double>& u) {
  clear();
  const double d = body_.grid.d;
  for (const FaceSpring& spring : springs_) {
    const double stress = spring.stiffness * strain_along(body_, u, spring.cell, spring.normal);
    for (int a = 0; a < 8; ++a) {
      const std::int64_t node = spring.cell + body_.layout.offset(corner(a));
      const double size = -0.25 * d * d * stress * dot(spring.normal, signs_of(a));
      for (std::size_t c = 0; c < 3; ++c) force_.component(static_cast<int>(c))[node] += size * spring.normal[c];
    }
  }
}

}  // namespace koshi::mechanics
