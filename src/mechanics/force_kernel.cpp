#include "mechanics/force_kernel.h"

#include <algorithm>
#include <cstring>

#include "base/poison.h"
#include "lattice/halo.h"
#include "mechanics/plain_fit.h"
#include "mechanics/stencil.h"

namespace koshi::mechanics {

using model::SpringLattice;

template <class T>
ForceKernel<T>::ForceKernel(const SpringLattice& lattice)
    : lattice_(lattice), components_(lattice.components()), volumetric_(lattice.has_volumetric()) {
  make_tables();
  make_segments();

  // Work space: 18 stencil rows, 4 cell rows, 6 force rows, each with the lead and the padding of a row of nodes.
  constexpr int stencil_rows = 18, cell_rows = 4;
  const lattice::Layout row({0, 0, 0}, {lattice.layout.owned()[0] + 32, 1, 1});
  work_ = lattice::Field<T>(lattice::Layout({0, 0, 0}, {row.pitch(), 1, 1}), stencil_rows + cell_rows + 6);
  int next = 0;
  const auto take = [&] { return work_.component(next++) + 4 * lattice::Layout::lead; };
  for (T*& r : scratch_.stencil) r = take();
  for (T*& r : scratch_.cell) r = take();
  for (T*& r : force_) r = take();
}

template <class T>
void ForceKernel<T>::make_tables() {
  const double d = lattice_.grid.d;
  // Classes are numbered family by family but do not know theirs: find one bond of each.
  std::array<int, 256> family;
  family.fill(-1);
  for (int slot = 0; slot < lattice::slot_count; ++slot) {
    const std::uint8_t* bond = lattice_.bond.component(slot);
    for (std::int64_t n = 0; n < lattice_.layout.size(); ++n)
      if (bond[n] != 0) family[bond[n]] = lattice::slots[slot].family;
  }
  constexpr int entries = Tables<T>::entries;
  kt_.assign(lattice::family_count * entries, 0);
  kb_.assign(lattice::family_count * entries, 0);
  for (int f = 0; f < lattice::family_count; ++f)
    tables_.family[f] = {kt_.data() + entries * f, kb_.data() + entries * f, 0, 0};
  for (int c = 1; c < static_cast<int>(lattice_.classes.size()); ++c) {
    const int f = family[c];
    if (f < 0) continue;
    typename Tables<T>::Family& table = tables_.family[f];
    if (table.size == 0) table.first = static_cast<std::uint8_t>(c - 1);
    table.size = c - table.first + 1;
    const model::BondClass& bond = lattice_.classes[c];
    kt_[entries * f + c] = static_cast<T>(bond.kt);
    kb_[entries * f + c] = static_cast<T>((bond.kn - bond.kt) / lattice::squared_length[f]);
  }
  volumetric_table_.assign(entries, 0);
  fit_table_.assign(entries, 0);
  stencils_.resize(lattice_.springs.size());
  faces_.resize(lattice_.springs.size());
  for (std::size_t m = 1; m < lattice_.springs.size(); ++m) {
    const material::Springs& s = lattice_.springs[m];
    volumetric_table_[m] = static_cast<T>(s.kappa * d / 16);
    fit_table_[m] = static_cast<T>((s.kt[0] / 4 + s.kt[1] + s.kt[2]) / 8);
    stencils_[m] = make_stencil<T>(s, d, lattice_.kinematics);
    faces_[m] = {make_face_stencil<T>(s, d, lattice_.kinematics, 1),
                 make_face_stencil<T>(s, d, lattice_.kinematics, -1)};
  }
  tables_.volumetric = volumetric_table_.data();
  tables_.fit = fit_table_.data();
  tables_.materials = static_cast<int>(lattice_.springs.size());
  tables_.half_d = static_cast<T>(0.5 * d);
}

template <class T>
typename ForceKernel<T>::Kind ForceKernel<T>::kind_of(std::int64_t node) const {
  const lattice::Layout& layout = lattice_.layout;
  const std::uint8_t* cell = lattice_.cell.component(0);
  // The cells above and below the node in x: the material where all four are of one, or none.
  std::array<int, 2> side;
  for (int below = 0; below < 2; ++below) {
    side[below] = cell[node - layout.offset({below, 0, 0})];
    for (int yz = 1; yz < 4; ++yz)
      if (cell[node - layout.offset({below, yz & 1, yz >> 1})] != side[below]) side[below] = -1;
  }
  if (side[0] == 0 && side[1] == 0) return Kind::empty;
  // With plain springs a bond on a surface has its full stiffness, and the parts of a cell under the least-squares
  // rotation depend on its neighbours. Rows of a few nodes are done faster in one go. (The rows of the body decide,
  // not this rank's part of them.)
  const bool shared = lattice_.sharing == material::Sharing::shared;
  if ((!shared && lattice_.kinematics == material::Kinematics::least_squares) || lattice_.grid.nodes()[0] <= 8)
    return Kind::bonds;
  if (side[0] == side[1] && side[0] > 0) return Kind::uniform;
  if (shared && side[0] > 0 && side[1] == 0) return Kind::face_above;
  if (shared && side[0] == 0 && side[1] > 0) return Kind::face_below;
  return Kind::bonds;
}

template <class T>
void ForceKernel<T>::make_segments() {
  const lattice::Layout& layout = lattice_.layout;
  const Int3& owned = layout.owned();
  const std::uint8_t* cell = lattice_.cell.component(0);
  for (std::int64_t k = 0; k < owned[2]; ++k)
    for (std::int64_t j = 0; j < owned[1]; ++j) {
      row_segments_.push_back(static_cast<std::int64_t>(segments_.size()));
      const std::int64_t n = layout.index(0, j, k);
      for (std::int64_t i = 0; i < owned[0]; ++i) {
        const Kind kind = kind_of(n + i);
        std::uint8_t material = 0;
        if (kind == Kind::uniform || kind == Kind::face_above) material = cell[n + i];
        if (kind == Kind::face_below) material = cell[n + i - 1];
        const bool begins = i == 0 || segments_.back().kind != kind || segments_.back().material != material;
        if (begins) segments_.push_back({static_cast<std::int32_t>(i), 0, kind, material});
        segments_.back().last = static_cast<std::int32_t>(i + 1);
      }
    }
  row_segments_.push_back(static_cast<std::int64_t>(segments_.size()));
}

template <class T>
T* const* ForceKernel<T>::row(const lattice::Field<T>& u, std::int64_t j, std::int64_t k) {
  const RowKernels<T>& kernels = row_kernels<T>();
  const lattice::Layout& layout = lattice_.layout;
  const bool rotational = components_ == 6;
  const std::int64_t n = layout.index(0, j, k);
  Row<T> row{};
  for (int c = 0; c < components_; ++c) row.u[c] = u.component(c) + n;
  for (int slot = 0; slot < lattice::slot_count; ++slot) row.bond[slot] = lattice_.bond.component(slot) + n;
  row.cell = lattice_.cell.component(0) + n;
  row.pitch = layout.pitch();
  row.plane = layout.plane();

  for (int c = 0; c < components_; ++c) poison(force_[c], static_cast<std::size_t>(layout.owned()[0]) * sizeof(T));
  // In ascending order, since a segment of bonds writes whole vectors and may spill into the next segment.
  const std::int64_t at = j + layout.owned()[1] * k;
  for (std::int64_t s = row_segments_[at]; s < row_segments_[at + 1]; ++s) {
    const Segment& segment = segments_[s];
    if (segment.kind == Kind::empty) {
      for (int c = 0; c < components_; ++c) std::fill(force_[c] + segment.first, force_[c] + segment.last, T{0});
      continue;
    }
    if (segment.kind == Kind::uniform) {
      (rotational ? kernels.uniform : kernels.uniform_displacement)(stencils_[segment.material], row, segment.first,
                                                                    segment.last, scratch_, force_.data());
      continue;
    }
    if (segment.kind != Kind::bonds) {
      const FaceStencil<T>& face = faces_[segment.material][segment.kind == Kind::face_above ? 0 : 1];
      (rotational ? kernels.face : kernels.face_displacement)(face, row, segment.first, force_.data());
      continue;
    }
    (rotational ? kernels.bonds : kernels.bonds_displacement)(tables_, row, segment.first, segment.last, force_.data());
    if (volumetric_) kernels.volumetric(tables_, row, segment.first, segment.last, scratch_, force_.data());
    if (!rotational && lattice_.sharing == material::Sharing::shared)
      kernels.fit(tables_, row, segment.first, segment.last, scratch_, force_.data());
    if (!rotational && lattice_.sharing == material::Sharing::plain)
      add_plain_fit(lattice_, u, j, k, segment.first, segment.last, force_.data());
  }
  return force_.data();
}

template <class T>
void ForceKernel<T>::write_row(const lattice::Field<T>& u, std::int64_t j, std::int64_t k, lattice::Field<T>& force) {
  T* const* f = row(u, j, k);
  const std::size_t bytes = static_cast<std::size_t>(lattice_.layout.owned()[0]) * sizeof(T);
  for (int c = 0; c < components_; ++c) std::memcpy(force.component(c) + lattice_.layout.index(0, j, k), f[c], bytes);
}

template <class T>
void ForceKernel<T>::poison_owned(lattice::Field<T>& force) const {
  const lattice::Layout& layout = lattice_.layout;
  for (int c = 0; c < components_; ++c)
    for (std::int64_t k = 0; k < layout.owned()[2]; ++k)
      for (std::int64_t j = 0; j < layout.owned()[1]; ++j)
        poison(force.component(c) + layout.index(0, j, k), static_cast<std::size_t>(layout.owned()[0]) * sizeof(T));
}

template <class T>
void ForceKernel<T>::apply(lattice::Field<T>& u, lattice::Field<T>& force) {
  const Int3& owned = lattice_.layout.owned();
  const bool halo = lattice_.halo->active();
  // Rows away from the border in y and z need no ghosts while the body is not cut across x: they hide the exchange.
  const bool rows_are_whole = owned[0] == lattice_.grid.nodes()[0] && !lattice_.grid.periodic[0];
  const auto inner = [&](std::int64_t j, std::int64_t k) {
    return rows_are_whole && j > 0 && k > 0 && j + 1 < owned[1] && k + 1 < owned[2];
  };
  poison_owned(force);
  if (halo) lattice_.halo->begin(u);
  for (std::int64_t k = 0; k < owned[2]; ++k)
    for (std::int64_t j = 0; j < owned[1]; ++j)
      if (!halo || inner(j, k)) write_row(u, j, k, force);
  if (!halo) return;
  lattice_.halo->end();
  for (std::int64_t k = 0; k < owned[2]; ++k)
    for (std::int64_t j = 0; j < owned[1]; ++j)
      if (!inner(j, k)) write_row(u, j, k, force);
}

template class ForceKernel<double>;
template class ForceKernel<float>;

}  // namespace koshi::mechanics
