#include "mechanics/surface_stress.h"

#include <Eigen/QR>
#include <Eigen/SVD>

#include <cmath>
#include <utility>

#include "lattice/halo.h"
#include "mechanics/corner_modes.h"
#include "mechanics/cut_forces.h"
#include "model/moments.h"

namespace koshi::mechanics {
namespace {

// The 27 cells of a block of three by three by three; the one in the middle is number 13.
constexpr int block = 27;
constexpr int middle = 13;

Int3 step_of(int neighbour) { return {neighbour % 3 - 1, neighbour / 3 % 3 - 1, neighbour / 9 - 1}; }

// Curvatures of a field that change its values at the cells around one by less than this, in the square root of the sum
// of their squares for a curvature of 1, are taken as none.
constexpr double least_curve = 0.3;

// 1, x, y, z, x^2, y^2, z^2, yz, xz, xy, and the numbers of these moments.
std::array<double, 10> powers_of(const Vec3& x) {
  return {1, x[0], x[1], x[2], x[0] * x[0], x[1] * x[1], x[2] * x[2], x[1] * x[2], x[0] * x[2], x[0] * x[1]};
}
constexpr std::array<std::size_t, 10> moment_of = [] {
  const auto at = [](int a, int b, int c) { return static_cast<std::size_t>(model::moment_index({a, b, c})); };
  return std::array<std::size_t, 10>{at(0, 0, 0), at(1, 0, 0), at(0, 1, 0), at(0, 0, 1), at(2, 0, 0),
                                     at(0, 2, 0), at(0, 0, 2), at(0, 1, 1), at(1, 0, 1), at(1, 1, 0)};
}();

// Means of the powers about a centre `step` away, from those about the own one.
std::array<double, 10> moved(const std::array<double, 10>& mean, const Int3& step) {
  const Vec3 s{static_cast<double>(step[0]), static_cast<double>(step[1]), static_cast<double>(step[2])};
  std::array<double, 10> sum = powers_of(s);
  for (std::size_t a = 0; a < 3; ++a) {
    const std::size_t b = (a + 1) % 3, c = (a + 2) % 3;
    sum[1 + a] += mean[1 + a];
    sum[4 + a] += 2 * s[a] * mean[1 + a] + mean[4 + a];
    sum[7 + a] += s[b] * mean[1 + c] + s[c] * mean[1 + b] + mean[7 + a];
  }
  return sum;
}

// Mean strain of the trilinear displacement over the part of a cell inside: u_i = sum_p A_i^p x^p, p as bits of axes.
Tensor6 part_strain(const CellMotion& motion, const model::Moments& moments, double d) {
  std::array<Vec3, 3> gradient{};  // du_i/dx_j
  for (int p = 1; p < 8; ++p) {
    Vec3 amplitude{};
    for (int a = 0; a < 8; ++a)
      amplitude = amplitude + 0.125 * mode_sign(a, p) * motion.displacement[static_cast<std::size_t>(a)];
    for (int j = 0; j < 3; ++j) {
      if ((p >> j & 1) == 0) continue;
      const int left = p & ~(1 << j), moment = model::moment_index({left & 1, left >> 1 & 1, left >> 2});
      for (std::size_t i = 0; i < 3; ++i)
        gradient[i][static_cast<std::size_t>(j)] +=
            2 / d * amplitude[i] * moments[static_cast<std::size_t>(moment)] / moments[0];
    }
  }
  Tensor6 strain;
  for (std::size_t v = 0; v < 6; ++v) {
    const auto [i, j] = tensor_axes[v];
    strain[v] = 0.5 * (gradient[i][j] + gradient[j][i]);
  }
  return strain;
}

}  // namespace

SurfaceStress::SurfaceStress(const model::SpringLattice& body, std::span<const std::int64_t> cells)
    : body_(body), cells_(cells.begin(), cells.end()), material_(body.layout, 1), part_(body.layout, 1) {
  lattice::for_each_owned(body.layout, [&](auto, auto, auto, auto n) {
    const std::uint16_t material = body.cell.component(0)[n];
    if (material == 0) return;
    material_.component(0)[n] = material;
    part_.component(0)[n] = static_cast<float>(body.fraction_of(n));
  });
  body.halo->exchange(material_);
  body.halo->exchange(part_);

  // Marks: 3 at the cells, 2 and 1 at those one and two cells away.
  const lattice::Layout& layout = body.layout;
  lattice::Field<std::uint8_t> mark(layout, 1);
  for (const std::int64_t cell : cells_) mark.component(0)[cell] = 3;
  for (const std::uint8_t ring : {3, 2}) {
    body.halo->exchange(mark);
    lattice::Field<std::uint8_t> grown = mark;
    lattice::for_each_owned(layout, [&](auto, auto, auto, auto n) {
      for (int b = 0; b < block && mark.component(0)[n] == 0; ++b)
        if (mark.component(0)[n + offset(b)] == ring) {
          grown.component(0)[n] = static_cast<std::uint8_t>(ring - 1);
          break;
        }
    });
    mark = std::move(grown);
  }
  body.halo->exchange(mark);
  const Int3& owned = layout.owned();
  lattice::for_each(layout, {-1, -1, -1}, {owned[0] + 1, owned[1] + 1, owned[2] + 1},
                    [&](auto i, auto j, auto k, auto n) {
                      if (mark.component(0)[n] == 0 || material_.component(0)[n] == 0) return;
                      near_.push_back({n, 3 - mark.component(0)[n], layout.owns({i, j, k})});
                      known_[n] = {};
                    });
  // Ghosts get their numbers from their owners.
  for (const Near& near : near_)
    if (near.owned) known_.at(near.cell).mean = means(near.cell);
  for (std::size_t q = 0; q < powers; ++q) exchange([&](Known& known) -> double& { return known.mean[q]; });
}

std::int64_t SurfaceStress::offset(int neighbour) const {
  const Int3 step = step_of(neighbour);
  return step[0] + step[1] * body_.layout.pitch() + step[2] * body_.layout.plane();
}

template <class Member>
void SurfaceStress::exchange(Member&& number_of) {
  if (!body_.halo->active()) return;
  lattice::Field<double> field(body_.layout, 1);
  for (const Near& near : near_) field.component(0)[near.cell] = number_of(known_.at(near.cell));
  body_.halo->exchange(field);
  for (const Near& near : near_) number_of(known_.at(near.cell)) = field.component(0)[near.cell];
}

void SurfaceStress::update(const lattice::Field<double>& u) {
  const auto numbers = [&](std::int64_t cell) {
    CellState state = material_state(body_, u, cell);
    if (const model::SurfaceCell* const cut = surface_cell(body_, cell))
      state.strain = part_strain(cell_motion(body_, u, cell), cut->moments, body_.grid.d);
    Numbers all{};
    for (std::size_t v = 0; v < 6; ++v) {
      all[v] = state.strain[v];
      all[6 + v] = state.stress[v];
    }
    return all;
  };
  for (const Near& near : near_)
    if (near.owned) known_.at(near.cell).value = numbers(near.cell);
  for (std::size_t c = 0; c < components; ++c) exchange([&](Known& known) -> double& { return known.value[c]; });

  for (const Near& near : near_)
    if (near.owned && near.distance < 2 && whole(near.cell)) known_.at(near.cell).field = fit(near.cell);
  for (std::size_t q = 0; q < powers; ++q)
    for (std::size_t c = 0; c < components; ++c) exchange([&](Known& known) -> double& { return known.field[q][c]; });

  alone_.clear();
  for (const std::int64_t cell : cells_) {
    bool helped = whole(cell);
    for (int b = 0; b < block && !helped; ++b) helped = whole(cell + offset(b)) && alike(cell, cell + offset(b));
    if (!helped) alone_[cell] = numbers(cell);
  }
}

std::array<double, SurfaceStress::powers> SurfaceStress::means(std::int64_t cell) const {
  std::array<double, powers> mean{1, 0, 0, 0, 1.0 / 12, 1.0 / 12, 1.0 / 12, 0, 0, 0};
  const model::SurfaceCell* const cut = surface_cell(body_, cell);
  if (cut == nullptr) return mean;
  // Moments are in half edges.
  for (std::size_t q = 1; q < powers; ++q)
    mean[q] = (q < 4 ? 0.5 : 0.25) * cut->moments[moment_of[q]] / cut->moments[0];
  return mean;
}

std::array<SurfaceStress::Numbers, SurfaceStress::powers> SurfaceStress::fit(std::int64_t cell) const {
  std::array<int, block> around{};
  Eigen::Index count = 0;
  for (int b = 0; b < block; ++b)
    if (alike(cell, cell + offset(b))) around[static_cast<std::size_t>(count++)] = b;
  // Small parts are noisy: each counts by the square of the part, as a sum of squares takes it to the fourth power.
  Eigen::MatrixXd line(count, 4), curve(count, 6), value(count, static_cast<Eigen::Index>(components));
  for (Eigen::Index r = 0; r < count; ++r) {
    const int b = around[static_cast<std::size_t>(r)];
    const std::int64_t other = cell + offset(b);
    const Known& known = known_.at(other);
    const double part = static_cast<double>(part_.component(0)[other]), weight = part * part;
    const auto mean = moved(known.mean, step_of(b));
    for (std::size_t q = 0; q < powers; ++q)
      (q < 4 ? line(r, static_cast<Eigen::Index>(q)) : curve(r, static_cast<Eigen::Index>(q) - 4)) = weight * mean[q];
    for (std::size_t c = 0; c < components; ++c) value(r, static_cast<Eigen::Index>(c)) = weight * known.value[c];
  }
  // A linear field first; curvatures from what is left, as far as these cells tell them from linear fields. Stairs make
  // noise that curvatures would only follow: bodies without cut cells have none.
  const auto lines = line.completeOrthogonalDecomposition();
  const Eigen::MatrixXd straight = lines.solve(value), curve_line = lines.solve(curve);
  const Eigen::JacobiSVD<Eigen::MatrixXd> curves(curve - line * curve_line, Eigen::ComputeThinU | Eigen::ComputeThinV);
  Eigen::VectorXd inverse = Eigen::VectorXd::Zero(curves.singularValues().size());
  for (Eigen::Index q = 0; q < inverse.size() && body_.fraction.components() != 0; ++q)
    if (curves.singularValues()(q) > least_curve) inverse(q) = 1 / curves.singularValues()(q);
  const Eigen::MatrixXd bent =
      curves.matrixV() * (inverse.asDiagonal() * (curves.matrixU().transpose() * (value - line * straight)));
  const Eigen::MatrixXd level = straight - curve_line * bent;
  std::array<Numbers, powers> field;
  for (std::size_t q = 0; q < powers; ++q)
    for (std::size_t c = 0; c < components; ++c)
      field[q][c] = q < 4 ? level(static_cast<Eigen::Index>(q), static_cast<Eigen::Index>(c))
                          : bent(static_cast<Eigen::Index>(q) - 4, static_cast<Eigen::Index>(c));
  return field;
}

SurfaceStress::Value SurfaceStress::at(std::int64_t cell, const Vec3& from_centre) const {
  Numbers sum{};
  double weights = 0;
  const auto add = [&](int b) {
    const Known& known = known_.at(cell + offset(b));
    const Int3 step = step_of(b);
    const Vec3 from =
        from_centre - Vec3{static_cast<double>(step[0]), static_cast<double>(step[1]), static_cast<double>(step[2])};
    const double weight = 1 / (dot(from, from) + 1e-3);
    weights += weight;
    const auto power = powers_of(from);
    for (std::size_t q = 0; q < powers; ++q)
      for (std::size_t c = 0; c < components; ++c) sum[c] += weight * power[q] * known.field[q][c];
  };
  if (const auto alone = alone_.find(cell); alone != alone_.end()) {
    sum = alone->second;
    weights = 1;
  } else if (whole(cell)) {
    add(middle);
  } else {
    for (int b = 0; b < block; ++b)
      if (whole(cell + offset(b)) && alike(cell, cell + offset(b))) add(b);
  }
  Value value;
  for (std::size_t v = 0; v < 6; ++v) {
    value.strain[v] = sum[v] / weights;
    value.stress[v] = sum[6 + v] / weights;
  }
  return value;
}

Vec3 SurfaceStress::middle_of_part(std::int64_t cell) const {
  const auto mean = means(cell);
  return {mean[1], mean[2], mean[3]};
}

}  // namespace koshi::mechanics
