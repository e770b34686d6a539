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

// Stiffness of the tie of a loose corner, over d^3: enough that no cell has a negative energy, whatever its loose
// corners, for nu from -0.5 to 0.5, and so little that the stable step stays (tests/unit/test_cut_forces.cpp,
// test_cut.cpp).
double tie_of(double c12, double c44) { return 0.3 * c44 + 0.6 * std::max(0.0, -c12); }

// Part of the energy of a whole cell's strain gradients that a cut cell has beside that of the part inside, times its
// fraction: corners that the part hardly reaches would hang loose. Uniform strain does not feel it.
constexpr double steadying = 0.1;

// What the displacements of a cell give to its node rotations that turn with the cell (by least squares): Kwu + Kww W.
Eigen::MatrixXd given_to_rotations(const material::Springs& springs, double d) {
  const Eigen::MatrixXd K = cell_matrix(springs, d, material::Kinematics::rotational);
  Eigen::MatrixXd wu(24, 24), ww(24, 24), W = Eigen::MatrixXd::Zero(24, 24);
  for (Eigen::Index p = 0; p < 24; ++p)
    for (Eigen::Index q = 0; q < 24; ++q) {
      wu(p, q) = K(p / 3 * 6 + p % 3 + 3, q / 3 * 6 + q % 3);
      ww(p, q) = K(p / 3 * 6 + p % 3 + 3, q / 3 * 6 + q % 3 + 3);
    }
  for (int a = 0; a < 8; ++a)
    for (int b = 0; b < 8; ++b)
      for (int c = 0; c < 3; ++c) {
        const int i = (c + 1) % 3, j = (c + 2) % 3;
        W(3 * a + c, 3 * b + j) = (2 * corner(b)[static_cast<std::size_t>(i)] - 1) / (8 * d);
        W(3 * a + c, 3 * b + i) = -(2 * corner(b)[static_cast<std::size_t>(j)] - 1) / (8 * d);
      }
  return wu + ww * W;
}

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
  static constexpr model::Moments whole{1};
  const bool cut = cell.part >= 0;
  const double factor = body.factor_of(cell.cell);
  block.coupled[lane] = factor;
  block.whole[lane] = cut ? factor : 0;
  block.part[lane] = cut ? factor / body.fraction_of(cell.cell) : 0;
  const model::Moments& moments = cut ? body.moments[static_cast<std::size_t>(cell.part)] : whole;
  for (std::size_t m = 0; m < moments.size(); ++m) block.moments[m][lane] = moments[m];
  // Gradients are the terms x, y, z, yz, xz, xy of the strain; their squares are moments that nothing else needs.
  if (cut)
    for (std::size_t m = 0; m < 3; ++m) {
      block.moments[square + m][lane] += steadying * moments[0] / 3;
      block.moments[square_of_pair + m][lane] += steadying * moments[0] / 9;
    }
  for (std::size_t a = 0; a < 8; ++a) block.loose[a][lane] = cell.corners >> a & 1;
}

// The entry between the amplitudes p of u_i and q of u_j, where u of corner a is a product of signs.
double between(const Eigen::MatrixXd& K, int i, int p, int j, int q) {
  const auto sign = [](int a, int mode) {
    return std::popcount(static_cast<unsigned>(~a & mode)) % 2 == 0 ? 1.0 : -1.0;
  };
  double sum = 0;
  for (int a = 0; a < 8; ++a)
    for (int b = 0; b < 8; ++b) sum += sign(a, p) * sign(b, q) * K(3 * a + i, 3 * b + j);
  return sum;
}

// The constants of stiffness and turn that belong to unit constants of the cell kernel, d = 2; the others zero.
std::array<CutConstants, cell_constants> make_basis(material::Kinematics kinematics) {
  std::array<CutConstants, cell_constants> basis{};
  for (std::size_t q = 0; q < basis.size(); ++q) {
    CutConstants& k = basis[q];
    const Eigen::MatrixXd K = cell_matrix(unit_springs[q], 2, material::Kinematics::least_squares);
    const auto in_class = [&](int P, int i, int j) { return between(K, i, P ^ 1 << i, j, P ^ 1 << j); };
    k.none = in_class(0, 0, 0);
    k.none_cross = in_class(0, 0, 1);
    k.one = in_class(1, 1, 1);
    k.one_cross = in_class(1, 1, 2);
    k.two = in_class(3, 0, 0);
    k.two_cross = in_class(3, 0, 1);
    k.two_third = in_class(3, 0, 2);
    k.third = in_class(3, 2, 2);
    k.three = in_class(7, 0, 0);
    k.three_cross = in_class(7, 0, 1);
    if (kinematics == material::Kinematics::least_squares) continue;
    const Eigen::MatrixXd G = given_to_rotations(unit_springs[q], 2);
    // Modes as bits: x 1, y 2, z 4.
    k.turn_none = between(G, 0, 6, 1, 2);
    k.turn_one = between(G, 0, 7, 1, 3);
    k.turn_one_axis = between(G, 1, 4, 2, 5);
    k.turn_two = between(G, 0, 5, 0, 2);
    k.turn_two_third = -between(G, 0, 5, 2, 7);
    k.turn_three = between(G, 0, 1, 1, 5);
  }
  return basis;
}

}  // namespace

CutConstants cut_constants_of(const material::Springs& springs, double d, material::Kinematics kinematics) {
  using material::Kinematics;
  static const std::array<CutConstants, cell_constants> turning = make_basis(Kinematics::rotational),
                                                        without = make_basis(Kinematics::least_squares);
  const auto& basis = kinematics == Kinematics::rotational ? turning : without;
  const CellConstants own = springs_of_cell(springs, d);
  CutConstants k{};
  for (std::size_t q = 0; q < basis.size(); ++q) {
    // Moments are per rotation times half an edge.
    const auto add = [&](double CutConstants::*member, double unit) { k.*member += unit * own[q] * basis[q].*member; };
    for (const auto member :
         {&CutConstants::none, &CutConstants::none_cross, &CutConstants::one, &CutConstants::one_cross,
          &CutConstants::two, &CutConstants::two_cross, &CutConstants::two_third, &CutConstants::third,
          &CutConstants::three, &CutConstants::three_cross})
      add(member, 1);
    for (const auto member : {&CutConstants::turn_none, &CutConstants::turn_one, &CutConstants::turn_one_axis,
                              &CutConstants::turn_two, &CutConstants::turn_two_third, &CutConstants::turn_three})
      add(member, 0.5 * d);
  }
  const material::ElasticTensor C = material::lattice_tensor(springs, d);
  const double c11 = C.voigt[0][0], c12 = C.voigt[0][1], c44 = C.voigt[3][3];
  k.bulk = 4 * d * (c11 + 2 * c12) / 3;
  k.shear = 4 * d * (c11 - c12);
  k.cross = 4 * d * c44;
  k.per_d = 1 / d;
  k.tie = tie_of(c12, c44) * d * d * d;
  return k;
}

const model::SurfaceCell* surface_cell(const model::SpringLattice& body, std::int64_t cell) {
  const auto found = std::lower_bound(body.surface.begin(), body.surface.end(), cell,
                                      [](const model::SurfaceCell& one, std::int64_t at) { return one.cell < at; });
  return found != body.surface.end() && found->cell == cell ? &*found : nullptr;
}

CellMotion cut_forces(const model::SpringLattice& body, const model::SurfaceCell& cell, const CellMotion& motion) {
  CutBlock block{};
  const bool rotational = body.components() == 6;
  const material::Springs& springs = body.springs[body.cell.component(0)[cell.cell]];
  const CutConstants constants = cut_constants_of(springs, body.grid.d, body.kinematics);
  for (std::size_t lane = 0; lane < cut_lanes; ++lane) {
    set_constants(constants, lane, block);
    set_cell(body, cell, lane, block);
    for (std::size_t a = 0; a < 8; ++a)
      for (std::size_t i = 0; i < 3; ++i) {
        block.u[i][a][lane] = motion.displacement[a][i];
        block.w[i][a][lane] = motion.rotation[a][i];
      }
  }
  cut_kernels().forces(block, rotational);
  CellMotion force;
  for (std::size_t a = 0; a < 8; ++a)
    for (std::size_t i = 0; i < 3; ++i) {
      force.displacement[a][i] = block.u[i][a][0];
      if (rotational) force.rotation[a][i] = block.w[i][a][0];
    }
  return force;
}

CutForces::CutForces(const model::SpringLattice& body)
    : body_(body), rotational_(body.components() == 6), constants_(body.springs.size()) {
  std::vector<char> known(body.springs.size(), 0);
  for (const model::SurfaceCell& cell : body.surface) {
    const std::uint16_t material = body.cell.component(0)[cell.cell];
    if (known[material] == 0)
      constants_[material] = cut_constants_of(body.springs[material], body.grid.d, body.kinematics);
    known[material] = 1;
    // Whole cells differ by what ties strain and rotations alone.
    if (rotational_ || cell.part >= 0) cells_.push_back(cell);
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
void CutForces::update(const NodeValues<T>& u, const Rows& rows, double turn) {
  if (rows.empty()) return;
  for (std::int64_t k = rows.k0; k < rows.k1; ++k)
    std::fill(force_.begin() + first_node_[node_row(rows.j0, k)],
              force_.begin() + first_node_[node_row(rows.j1 - 1, k) + 1], NodeForces{});
  for (std::int64_t k = rows.k0 - 1; k < rows.k1; ++k)
    add_cells(u, turn, first_cell_[cell_row(rows.j0 - 1, k)], first_cell_[cell_row(rows.j1 - 1, k) + 1]);
}

template <class T>
void CutForces::add_cells(const NodeValues<T>& u, double turn, std::size_t first, std::size_t last) {
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
      for (int c = 0; c < body_.components(); ++c) {
        const T* const from = u.of(i, j, k) + c * u.component;
        auto& to = c < 3 ? block.u[c] : block.w[c - 3];
        for (std::size_t a = 0; a < 8; ++a) to[a][lane] = (c < 3 ? 1 : turn) * static_cast<double>(from[offset[a]]);
      }
    }
    cut_kernels().forces(block, rotational_);
    for (std::size_t lane = 0; lane < cut_lanes && begin + lane < last; ++lane)
      for (std::size_t a = 0; a < 8; ++a) {
        NodeForces& force = force_[corners_[begin + lane][a]];
        for (std::size_t i = 0; i < 3; ++i) {
          force[i] += block.u[i][a][lane];
          if (rotational_) force[3 + i] += block.w[i][a][lane];
        }
      }
  }
}

template <class T>
void CutForces::add(std::int64_t j, std::int64_t k, T* const* force, double scale, double turn) const {
  const std::size_t row = node_row(j, k), components = static_cast<std::size_t>(body_.components());
  for (std::size_t n = first_node_[row]; n < first_node_[row + 1]; ++n)
    for (std::size_t c = 0; c < components; ++c)
      force[c][place_[n]] += static_cast<T>((c < 3 ? scale : scale * turn) * force_[n][c]);
}

std::vector<CutForces::NodeBlock> CutForces::node_blocks() const {
  std::vector<NodeBlock> blocks(force_.size());
  const int components = body_.components();
  // Component c of each corner in turn is 1 in its lane.
  CutBlock block{};
  for (std::size_t number = 0; number < cells_.size(); ++number)
    for (int c = 0; c < components; ++c) {
      for (std::size_t lane = 0; lane < cut_lanes; ++lane) {
        set_constants(constants_[body_.cell.component(0)[cells_[number].cell]], lane, block);
        set_cell(body_, cells_[number], lane, block);
        for (int e = 0; e < components; ++e)
          for (std::size_t a = 0; a < 8; ++a) (e < 3 ? block.u[e] : block.w[e - 3])[a][lane] = e == c && a == lane;
      }
      cut_kernels().forces(block, rotational_);
      for (std::size_t a = 0; a < 8; ++a)
        for (int e = 0; e < components; ++e)
          blocks[corners_[number][a]].stiffness[static_cast<std::size_t>(6 * e + c)] -=
              (e < 3 ? block.u[e] : block.w[e - 3])[a][a];
    }
  blocks.pop_back();
  const Int3& owned = body_.layout.owned();
  for (std::int64_t k = 0; k < owned[2]; ++k)
    for (std::int64_t j = 0; j < owned[1]; ++j)
      for (std::size_t n = first_node_[node_row(j, k)]; n < first_node_[node_row(j, k) + 1]; ++n)
        blocks[n].node = {place_[n], j, k};
  return blocks;
}

template void CutForces::update(const NodeValues<double>&, const Rows&, double);
template void CutForces::update(const NodeValues<float>&, const Rows&, double);
template void CutForces::add(std::int64_t, std::int64_t, double* const*, double, double) const;
template void CutForces::add(std::int64_t, std::int64_t, float* const*, double, double) const;

}  // namespace koshi::mechanics
