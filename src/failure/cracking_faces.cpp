// Cells that have cracked, in motion: each of them is looked at in every step, and what its faces carry if they are
// closed.
#include <algorithm>
#include <limits>

#include "failure/cracking.h"

namespace koshi::failure {
namespace {

// Values of cells so many further on in the list are fetched into the cache.
constexpr std::size_t ahead = 8;

}  // namespace

Cracking::Face Cracking::face_of(std::int64_t n) const {
  const Crack crack = load(n);
  const double further = crack.damage >= 1 ? std::numeric_limits<double>::infinity() : margin * crack.kappa;
  return {n, model_.lattice.cell.component(0)[n], false, share(n, crack), further, crack.normal, crack.slip};
}

void Cracking::restore_faces() {
  faces_.clear();
  carried_.begin();
  for (const std::int64_t n : cracked_) {
    faces_.push_back(face_of(n));
    carry(faces_.back(), mechanics::quick_cell_strain(model_.lattice, state_.displacement, n));
  }
  carried_.end();
  laid_ = false;
  lay_forces();
}

// Those that have cracked in this step stand behind the others.
void Cracking::insert_faces(std::size_t known) {
  const auto fresh = cracked_.begin() + static_cast<std::ptrdiff_t>(known);
  std::sort(fresh, cracked_.end());
  faces_.resize(cracked_.size());
  std::size_t left = known, to = faces_.size();
  for (auto cell = cracked_.end(); cell != fresh;) {
    --cell;
    for (; left > 0 && faces_[left - 1].cell > *cell; --left) faces_[--to] = faces_[left - 1];
    faces_[--to] = face_of(*cell);
    faces_[to].fresh = true;
  }
  for (std::size_t m = 0; m < cracked_.size(); ++m) cracked_[m] = faces_[m].cell;
}

void Cracking::fetch_face(std::size_t at) const {
  if (at >= faces_.size()) return;
  const std::int64_t n = faces_[at].cell, y = model_.layout().pitch(), z = model_.layout().plane();
  for (int c = 0; c < 3; ++c) {
    const double* const u = state_.displacement.component(c) + n;
    for (const double* row : {u, u + y, u + z, u + y + z}) __builtin_prefetch(row, 0, 3);
    __builtin_prefetch(state_.crack.component(slip + c) + n, 1, 3);
  }
}

void Cracking::follow_faces(double dt) {
  carried_.begin();
  for (std::size_t m = 0; m < faces_.size(); ++m) {
    fetch_face(m + ahead);
    Face& face = faces_[m];
    const Tensor6 strain = mechanics::quick_cell_strain(model_.lattice, state_.displacement, face.cell);
    const auto [mean, radius] = mean_radius(strain);
    if (!face.fresh && bounds_[face.material](mean, radius) > face.further) {
      crack_further(face.cell, dt);
      face = face_of(face.cell);
    }
    face.fresh = false;
    slide(face, strain);
    carry(face, strain);
  }
  carried_.end();
  laid_ = false;
}

void Cracking::slide(Face& face, const Tensor6& strain) {
  const double d = model_.lattice.grid.d;
  Crack crack;
  crack.normal = face.normal;
  crack.slip = face.slip;
  const double heat = laws_[face.material]->slide_faces(crack, strain);
  for (std::size_t a = 0; a < 3; ++a)
    if (crack.slip[a] != face.slip[a]) state_.crack.component(slip + static_cast<int>(a))[face.cell] = crack.slip[a];
  face.slip = crack.slip;
  if (heat != 0) state_.crack.component(dissipated)[face.cell] += face.share * heat * d * d * d;
}

// A stress sigma in a cell gives its corner s, -1 or 1 along each axis, the force -d^2/4 sigma.s, since its work is
// d^3 sigma : strain with the strain of (2.5).
void Cracking::carry(const Face& face, const Tensor6& strain) {
  Crack crack;
  crack.normal = face.normal;
  crack.slip = face.slip;
  const FaceContact contact = laws_[face.material]->faces(crack, strain);
  if (contact.energy == 0) return;
  const double d = model_.lattice.grid.d, scale = -0.25 * d * d * face.share;
  Tensor6 pull;
  for (std::size_t v = 0; v < 6; ++v) pull[v] = scale * contact.stress[v];
  carried_.push(face.cell, pull);
}

void Cracking::lay_forces() {
  if (laid_) return;
  const Int3& owned = model_.layout().owned();
  state_.face_force.zero();
  for (std::int64_t k = 0; k < owned[2]; ++k)
    for (std::int64_t j = 0; j < owned[1]; ++j) {
      const std::int64_t n = model_.layout().index(0, j, k);
      double* const row[3] = {state_.face_force.component(0) + n, state_.face_force.component(1) + n,
                              state_.face_force.component(2) + n};
      carried_.add(j, k, row);
    }
  laid_ = true;
}

double Cracking::stored_energy(std::int64_t n) const {
  const double d = model_.lattice.grid.d;
  const Crack crack = load(n);
  const Tensor6 strain = mechanics::cell_strain(model_.lattice, state_.displacement, n);
  return share(n, crack) * law(n).faces(crack, strain).energy * d * d * d;
}

}  // namespace koshi::failure
