// Forces and energies of closed crack faces.
#include "failure/cracking.h"
#include "mechanics/corners.h"

namespace koshi::failure {

void Cracking::clear_faces() {
  for (const std::int64_t n : pressed_) forces_.clear(n);
  pressed_.clear();
}

// What faces need of a crack, and what they change of it.
Crack Cracking::load_faces(std::int64_t n) const {
  Crack crack;
  crack.damage = state_.crack.component(damage)[n];
  for (int a = 0; a < 3; ++a) {
    crack.normal[static_cast<std::size_t>(a)] = state_.crack.component(normal + a)[n];
    crack.slip[static_cast<std::size_t>(a)] = state_.crack.component(slip + a)[n];
  }
  return crack;
}

void Cracking::slide(std::int64_t n, const Tensor6& strain, Crack& crack) {
  const double d = model_.lattice.grid.d;
  const double heat = law(n).slide_faces(crack, strain);
  for (int a = 0; a < 3; ++a) state_.crack.component(slip + a)[n] = crack.slip[static_cast<std::size_t>(a)];
  if (heat != 0) state_.crack.component(dissipated)[n] += share(n, crack) * heat * d * d * d;
}

// A stress sigma in a cell gives its corner s, -1 or 1 along each axis, the force -d^2/4 sigma.s, since its work is
// d^3 sigma : strain with the strain of (2.5).
void Cracking::close_faces(bool sliding) {
  const double d = model_.lattice.grid.d;
  for (const std::int64_t n : cracked_) {
    const Tensor6 strain = mechanics::cell_strain(model_.lattice, state_.displacement, n);
    Crack crack = load_faces(n);
    if (sliding) slide(n, strain, crack);
    const FaceContact faces = law(n).faces(crack, strain);
    if (faces.energy == 0) continue;
    pressed_.push_back(n);
    for (int a = 0; a < 8; ++a) {
      const Vec3 s{a & 1 ? 1.0 : -1.0, a >> 1 & 1 ? 1.0 : -1.0, a >> 2 ? 1.0 : -1.0};
      const Vec3 force = (-0.25 * d * d * share(n, crack)) * times(faces.stress, s);
      const std::int64_t node = n + model_.layout().offset(mechanics::corner(a));
      for (int c = 0; c < 3; ++c) state_.face_force.component(c)[node] += force[static_cast<std::size_t>(c)];
    }
  }
}

double Cracking::stored_energy(std::int64_t n) const {
  const double d = model_.lattice.grid.d;
  const Crack crack = load(n);
  const Tensor6 strain = mechanics::cell_strain(model_.lattice, state_.displacement, n);
  return share(n, crack) * law(n).faces(crack, strain).energy * d * d * d;
}

}  // namespace koshi::failure
