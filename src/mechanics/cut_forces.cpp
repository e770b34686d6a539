#include "mechanics/cut_forces.h"

#include <Eigen/Core>

#include <algorithm>
#include <bit>
#include <cstring>

#include "koshi/calibration.h"
#include "lattice/halo.h"
#include "mechanics/cell_matrix.h"
#include "mechanics/cell_table.h"
#include "model/moments.h"

namespace koshi::mechanics {
namespace {

// Part of the energy of a whole cell's strain gradients that a cut cell has beside that of the part inside, times its
// fraction: corners that the part hardly reaches would hang loose. Uniform strain does not feel it.
constexpr double steadying = 0.1;

// Adds the constants of lane `lane`.
void set_constants(const CutConstants& of, std::size_t lane, CutBlock& block) {
  std::array<double, cut_constants> all;
  std::memcpy(all.data(), &of, sizeof all);
  for (std::size_t q = 0; q < all.size(); ++q) block.constants[q][lane] = all[q];
}

// The first of the moments of x^2, y^2, z^2 and of y^2 z^2, x^2 z^2, x^2 y^2.
constexpr std::size_t square = model::moment_index({2, 0, 0}), square_of_pair = model::moment_index({0, 2, 2});

// What a cell has of its own.
void set_cell(const model::SpringLattice& body, const model::SurfaceCell& cell, std::size_t lane, CutBlock& block) {
  const double factor = body.factor_of(cell.cell);
  block.whole[lane] = factor;
  block.part[lane] = factor / body.fraction_of(cell.cell);
  const model::Moments& moments = cell.moments;
  for (std::size_t m = 0; m < moments.size(); ++m) block.moments[m][lane] = moments[m];
  // Gradients are the terms x, y, z, yz, xz, xy of the strain; their squares are moments that nothing else needs.
  for (std::size_t m = 0; m < 3; ++m) {
    block.moments[square + m][lane] += steadying * moments[0] / 3;
    block.moments[square_of_pair + m][lane] += steadying * moments[0] / 9;
  }
}

}  // namespace

CutConstants cut_constants_of(const material::Springs& springs, double d, material::Kinematics kinematics) {
  const auto [en, et, fb, ft, bb, bt, v] = springs_of_cell(springs, d);
  // The classes of cell_strip.cpp without the tie of strain. Amplitudes there are sums over the corners, 8 times those
  // here. Rotations that make the energy smallest: none in P = 0 and in shear; in P = x + y + z A = (Z - Y)/2, and
  // cyclic; in P = x A = (Z - Y)/(4 - 2 r), B = r A - Z, C = r A + Y with r = ft/(et + ft); in P = x + y a Z alone
  // turns A - B.
  CutConstants k{};
  const double all = 64, axial = en + fb + ft, t = et + ft, g = ft + bt;
  k.none = all * (axial + g + fb + bb + v);
  k.none_cross = all * (fb + bb + v);
  k.two = all * (0.5 * (t + g) + fb + bb);
  if (kinematics == material::Kinematics::rotational) {
    const double turned = t > 0 ? ft / (4 - 2 * ft / t) : 0, held = 0.5 * (et + g) + bt;
    k.one = all * (axial - turned);
    k.one_cross = all * (fb + turned);
    k.third = all * (2 * et + en + bt + bb - (held > 0 ? (et + bt) * (et + bt) / held : 0));
    k.three = all * (t + 2 * fb);
    k.three_cross = all * (fb + 0.5 * t);
  } else {
    k.one = all * (axial + t);
    k.one_cross = all * fb;
    k.third = all * (2 * et + en + bt + bb);
    k.three = all * 2 * (t + fb);
    k.three_cross = all * fb;
  }
  const material::ElasticTensor C = material::lattice_tensor(springs, d);
  const double c11 = C.voigt[0][0], c12 = C.voigt[0][1], c44 = C.voigt[3][3];
  k.bulk = 4 * d * (c11 + 2 * c12) / 3;
  k.shear = 4 * d * (c11 - c12);
  k.cross = 4 * d * c44;
  return k;
}

const model::SurfaceCell* surface_cell(const model::SpringLattice& body, std::int64_t cell) {
  const auto found = std::lower_bound(body.surface.begin(), body.surface.end(), cell,
                                      [](const model::SurfaceCell& one, std::int64_t at) { return one.cell < at; });
  return found != body.surface.end() && found->cell == cell ? &*found : nullptr;
}

std::array<Vec3, 8> cut_forces(const model::SpringLattice& body, const model::SurfaceCell& cell,
                               const std::array<Vec3, 8>& displacement) {
  CutBlock block{};
  const material::Springs& springs = body.springs[body.cell.component(0)[cell.cell]];
  const CutConstants constants = cut_constants_of(springs, body.grid.d, body.kinematics);
  for (std::size_t lane = 0; lane < cut_lanes; ++lane) {
    set_constants(constants, lane, block);
    set_cell(body, cell, lane, block);
    for (std::size_t a = 0; a < 8; ++a)
      for (std::size_t i = 0; i < 3; ++i) block.u[i][a][lane] = displacement[a][i];
  }
  cut_kernels().forces(block);
  std::array<Vec3, 8> force;
  for (std::size_t a = 0; a < 8; ++a)
    for (std::size_t i = 0; i < 3; ++i) force[a][i] = block.u[i][a][0];
  return force;
}

CutForces::CutForces(const model::SpringLattice& body)
    : body_(body), constants_(body.springs.size()), cells_(body.surface) {
  std::vector<char> known(body.springs.size(), 0);
  for (const model::SurfaceCell& cell : body.surface) {
    const std::uint16_t material = body.cell.component(0)[cell.cell];
    if (known[material] == 0)
      constants_[material] = cut_constants_of(body.springs[material], body.grid.d, body.kinematics);
    known[material] = 1;
  }
  const Int3& owned = body.layout.owned();
  for (std::int64_t k = -1; k < owned[2]; ++k)
    for (std::int64_t j = -1; j < owned[1]; ++j)
      first_cell_.push_back(static_cast<std::uint32_t>(
          std::lower_bound(cells_.begin(), cells_.end(), body.layout.index(-1, j, k),
                           [](const model::SurfaceCell& cell, std::int64_t at) { return cell.cell < at; }) -
          cells_.begin()));
  first_cell_.push_back(static_cast<std::uint32_t>(cells_.size()));
  find_nodes();
}

void CutForces::find_nodes() {
  const lattice::Layout& layout = body_.layout;
  const Int3& owned = layout.owned();
  // Rows of cells and nodes, as in memory.
  std::vector<std::int64_t> nodes;
  const auto each_corner = [&](const model::SurfaceCell& cell, auto&& f) {
    const Int3 low = layout.place(cell.cell);
    if (low_.size() < cells_.size())
      low_.push_back(
          {static_cast<std::int32_t>(low[0]), static_cast<std::int32_t>(low[1]), static_cast<std::int32_t>(low[2])});
    for (int a = 0; a < 8; ++a) {
      const auto step = corner(a);
      f(static_cast<std::size_t>(a), layout.owns({low[0] + step[0], low[1] + step[1], low[2] + step[2]}),
        cell.cell + layout.offset(step));
    }
  };
  for (const model::SurfaceCell& cell : cells_)
    each_corner(cell, [&](std::size_t, bool owns, std::int64_t node) {
      if (owns) nodes.push_back(node);
    });
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  corners_.reserve(cells_.size());
  for (const model::SurfaceCell& cell : cells_) {
    auto& of_cell = corners_.emplace_back();
    each_corner(cell, [&](std::size_t a, bool owns, std::int64_t node) {
      const auto at = owns ? std::lower_bound(nodes.begin(), nodes.end(), node) : nodes.end();
      of_cell[a] = static_cast<std::uint32_t>(at - nodes.begin());
    });
  }
  force_.resize(nodes.size() + 1);
  for (std::int64_t k = 0; k < owned[2]; ++k)
    for (std::int64_t j = 0; j < owned[1]; ++j)
      first_node_.push_back(static_cast<std::uint32_t>(
          std::lower_bound(nodes.begin(), nodes.end(), layout.index(0, j, k)) - nodes.begin()));
  first_node_.push_back(static_cast<std::uint32_t>(nodes.size()));
  place_.reserve(nodes.size());
  for (const std::int64_t node : nodes) place_.push_back(static_cast<std::int32_t>(layout.place(node)[0]));
}

template <class T>
void CutForces::update(const NodeValues<T>& u, const Rows& rows) {
  if (rows.empty()) return;
  for (std::int64_t k = rows.k0; k < rows.k1; ++k)
    std::fill(force_.begin() + first_node_[node_row(rows.j0, k)],
              force_.begin() + first_node_[node_row(rows.j1 - 1, k) + 1], NodeForces{});
  for (std::int64_t k = rows.k0 - 1; k < rows.k1; ++k)
    add_cells(u, first_cell_[cell_row(rows.j0 - 1, k)], first_cell_[cell_row(rows.j1 - 1, k) + 1]);
}

template <class T>
void CutForces::add_cells(const NodeValues<T>& u, std::size_t first, std::size_t last) {
  CutBlock block{};
  std::array<std::ptrdiff_t, 8> offset;
  for (int a = 0; a < 8; ++a) {
    const auto [x, y, z] = corner(a);
    offset[static_cast<std::size_t>(a)] = x + u.row * y + u.plane * z;
  }
  for (std::size_t begin = first; begin < last; begin += cut_lanes) {
    for (std::size_t lane = 0; lane < cut_lanes; ++lane) {
      const std::size_t number = std::min(begin + lane, last - 1);
      const model::SurfaceCell& cell = cells_[number];
      set_constants(constants_[body_.cell.component(0)[cell.cell]], lane, block);
      set_cell(body_, cell, lane, block);
      const auto [i, j, k] = low_[number];
      for (int c = 0; c < 3; ++c) {
        const T* const from = u.of(i, j, k) + c * u.component;
        for (std::size_t a = 0; a < 8; ++a) block.u[c][a][lane] = static_cast<double>(from[offset[a]]);
      }
    }
    cut_kernels().forces(block);
    for (std::size_t lane = 0; lane < cut_lanes && begin + lane < last; ++lane)
      for (std::size_t a = 0; a < 8; ++a) {
        NodeForces& force = force_[corners_[begin + lane][a]];
        for (std::size_t i = 0; i < 3; ++i) force[i] += block.u[i][a][lane];
      }
  }
}

template <class T>
void CutForces::add(std::int64_t j, std::int64_t k, T* const* force, double scale) const {
  const std::size_t row = node_row(j, k);
  for (std::size_t n = first_node_[row]; n < first_node_[row + 1]; ++n)
    for (std::size_t c = 0; c < 3; ++c) force[c][place_[n]] += static_cast<T>(scale * force_[n][c]);
}

std::vector<CutForces::NodeBlock> CutForces::node_blocks() const {
  std::vector<NodeBlock> blocks(force_.size());
  // Component c of each corner in turn is 1 in its lane.
  CutBlock block{};
  for (std::size_t number = 0; number < cells_.size(); ++number)
    for (int c = 0; c < 3; ++c) {
      for (std::size_t lane = 0; lane < cut_lanes; ++lane) {
        set_constants(constants_[body_.cell.component(0)[cells_[number].cell]], lane, block);
        set_cell(body_, cells_[number], lane, block);
        for (int e = 0; e < 3; ++e)
          for (std::size_t a = 0; a < 8; ++a) block.u[e][a][lane] = e == c && a == lane;
      }
      cut_kernels().forces(block);
      for (std::size_t a = 0; a < 8; ++a)
        for (int e = 0; e < 3; ++e)
          blocks[corners_[number][a]].stiffness[static_cast<std::size_t>(3 * e + c)] -= block.u[e][a][a];
    }
  blocks.pop_back();
  const Int3& owned = body_.layout.owned();
  for (std::int64_t k = 0; k < owned[2]; ++k)
    for (std::int64_t j = 0; j < owned[1]; ++j)
      for (std::size_t n = first_node_[node_row(j, k)]; n < first_node_[node_row(j, k) + 1]; ++n)
        blocks[n].node = {place_[n], j, k};
  return blocks;
}

template void CutForces::update(const NodeValues<double>&, const Rows&);
template void CutForces::update(const NodeValues<float>&, const Rows&);
template void CutForces::add(std::int64_t, std::int64_t, double* const*, double) const;
template void CutForces::add(std::int64_t, std::int64_t, float* const*, double) const;

}  // namespace koshi::mechanics
