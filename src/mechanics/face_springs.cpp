#include "mechanics/face_springs.h"

#include <algorithm>
#include <array>
#include <utility>

namespace koshi::mechanics {
namespace {

constexpr std::array<double, 2> side{-1, 1};

// Corner a of a cell, from its lowest one, and as a vector of signs.
std::array<int, 3> corner_of(int a) { return {a & 1, a >> 1 & 1, a >> 2}; }
Vec3 signs_of(int a) { return {side[a & 1], side[a >> 1 & 1], side[a >> 2]}; }

}  // namespace

// With the strain of (2.5), eps = sym(sum_s u(s) s)/(4 d), it is sum_s (n.u(s)) (n.s)/(4 d).
double strain_along(const model::SpringLattice& body, const lattice::Field<double>& u, std::int64_t cell,
                    const Vec3& normal) {
  double strain = 0;
  for (int a = 0; a < 8; ++a) {
    const std::int64_t node = cell + body.layout.offset(corner_of(a));
    const Vec3 at{u.component(0)[node], u.component(1)[node], u.component(2)[node]};
    strain += dot(normal, at) * dot(normal, signs_of(a));
  }
  return strain / (4 * body.grid.d);
}

FaceSprings::FaceSprings(const model::SpringLattice& body, lattice::Field<double>& force)
    : body_(body),
      force_(force),
      touched_(static_cast<std::size_t>(body.layout.owned()[1] * body.layout.owned()[2]), 0) {}

void FaceSprings::clear() {
  for (const FaceSpring& spring : springs_)
    for (int a = 0; a < 8; ++a)
      for (int c = 0; c < 3; ++c) force_.component(c)[spring.cell + body_.layout.offset(corner_of(a))] = 0;
}

void FaceSprings::set(std::vector<FaceSpring> springs) {
  clear();
  springs_ = std::move(springs);
  std::ranges::fill(touched_, 0);
  const lattice::Layout& layout = body_.layout;
  for (const FaceSpring& spring : springs_) {
    const std::int64_t k = spring.cell / layout.plane() - 1, j = spring.cell % layout.plane() / layout.pitch() - 1;
    for (int row = 0; row < 4; ++row) {
      const std::int64_t at_j = j + (row & 1), at_k = k + (row >> 1);
      if (at_j < 0 || at_k < 0 || at_j >= layout.owned()[1] || at_k >= layout.owned()[2]) continue;
      touched_[static_cast<std::size_t>(at_j + layout.owned()[1] * at_k)] = 1;
    }
  }
}

// The stress t n n in a cell gives its corner s the force -d^2/4 t (n.s) n.
void FaceSprings::update(const lattice::Field<double>& u) {
  clear();
  const double d = body_.grid.d;
  for (const FaceSpring& spring : springs_) {
    const double stress = spring.stiffness * strain_along(body_, u, spring.cell, spring.normal);
    for (int a = 0; a < 8; ++a) {
      const std::int64_t node = spring.cell + body_.layout.offset(corner_of(a));
      const double size = -0.25 * d * d * stress * dot(spring.normal, signs_of(a));
      for (std::size_t c = 0; c < 3; ++c) force_.component(static_cast<int>(c))[node] += size * spring.normal[c];
    }
  }
}

void FaceSprings::add(std::int64_t j, std::int64_t k, double* const* force) const {
  if (touched_[static_cast<std::size_t>(j + body_.layout.owned()[1] * k)] == 0) return;
  const std::int64_t n = body_.layout.index(0, j, k);
  for (int c = 0; c < 3; ++c)
    for (std::int64_t i = 0; i < body_.layout.owned()[0]; ++i) force[c][i] += force_.component(c)[n + i];
}

}  // namespace koshi::mechanics
