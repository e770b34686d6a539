#include "mechanics/surface_stress.h"

#include <Eigen/QR>

#include <cmath>
#include <utility>

#include "lattice/halo.h"
#include "mechanics/cut_forces.h"

namespace koshi::mechanics {
namespace {

// The 27 cells of a block of three by three by three; the one in the middle is number 13.
constexpr int block = 27;
constexpr int middle = 13;

Int3 step_of(int neighbour) { return {neighbour % 3 - 1, neighbour / 3 % 3 - 1, neighbour / 9 - 1}; }

}  // namespace

SurfaceStress::SurfaceStress(const model::SpringLattice& body, std::span<const std::int64_t> cells)
    : body_(body), cells_(cells.begin(), cells.end()), whole_(body.layout, 1) {
  lattice::for_each_owned(body.layout, [&](auto, auto, auto, auto n) {
    const std::uint16_t material = body.cell.component(0)[n];
    if (body.fraction_of(n) == 1) whole_.component(0)[n] = material;
  });
  body.halo->exchange(whole_);

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
                      if (mark.component(0)[n] == 0 || !whole(n)) return;
                      near_.push_back({n, 3 - mark.component(0)[n], layout.owns({i, j, k})});
                      known_[n] = {};
                    });
}

std::int64_t SurfaceStress::offset(int neighbour) const {
  const Int3 step = step_of(neighbour);
  return step[0] + step[1] * body_.layout.pitch() + step[2] * body_.layout.plane();
}

// Across a border of materials the stress jumps.
bool SurfaceStress::alike(std::int64_t a, std::int64_t b) const {
  return whole(b) && body_.cell.component(0)[a] == whole_.component(0)[b];
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
  const auto numbers = [](const CellState& state) {
    Numbers all{};
    for (std::size_t v = 0; v < 6; ++v) {
      all[v] = state.strain[v];
      all[6 + v] = state.stress[v];
    }
    return all;
  };
  // Ghosts get their numbers from their owners.
  for (const Near& near : near_)
    if (near.owned) known_.at(near.cell).value = numbers(cell_state(body_, u, near.cell));
  for (std::size_t c = 0; c < components; ++c) exchange([&](Known& known) -> double& { return known.value[c]; });

  // Linear fields fitted to the whole cells around each, which takes the noise that cut cells make beside them; exact
  // for linear fields. Where the cells lie in a plane the slope across it is taken as none.
  std::vector<std::pair<const Near*, Known>> fitted;
  for (const Near& near : near_)
    if (near.owned && near.distance < 2) fitted.emplace_back(&near, fit(near.cell));
  for (const auto& [near, known] : fitted) known_.at(near->cell) = known;
  for (std::size_t c = 0; c < components; ++c) exchange([&](Known& known) -> double& { return known.value[c]; });
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t c = 0; c < components; ++c) exchange([&](Known& known) -> double& { return known.slope[a][c]; });

  alone_.clear();
  for (const std::int64_t cell : cells_) {
    bool helped = whole(cell);
    for (int b = 0; b < block && !helped; ++b) helped = alike(cell, cell + offset(b));
    if (!helped) alone_[cell] = numbers(material_state(body_, u, cell));
  }
}

SurfaceStress::Known SurfaceStress::fit(std::int64_t cell) const {
  std::array<int, block> around{};
  Eigen::Index count = 0;
  for (int b = 0; b < block; ++b)
    if (alike(cell, cell + offset(b))) around[static_cast<std::size_t>(count++)] = b;
  Eigen::MatrixXd place(count, 4), value(count, static_cast<Eigen::Index>(components));
  for (Eigen::Index r = 0; r < count; ++r) {
    const int b = around[static_cast<std::size_t>(r)];
    const Int3 step = step_of(b);
    place.row(r) << 1, static_cast<double>(step[0]), static_cast<double>(step[1]), static_cast<double>(step[2]);
    const Numbers& numbers = known_.at(cell + offset(b)).value;
    for (std::size_t c = 0; c < components; ++c) value(r, static_cast<Eigen::Index>(c)) = numbers[c];
  }
  const Eigen::MatrixXd line = place.completeOrthogonalDecomposition().solve(value);
  Known known;
  for (std::size_t c = 0; c < components; ++c) {
    known.value[c] = line(0, static_cast<Eigen::Index>(c));
    for (std::size_t a = 0; a < 3; ++a)
      known.slope[a][c] = line(static_cast<Eigen::Index>(a) + 1, static_cast<Eigen::Index>(c));
  }
  return known;
}

SurfaceStress::Value SurfaceStress::at(std::int64_t cell, const Vec3& from_centre) const {
  Numbers sum{};
  double weights = 0;
  const auto add = [&](int b) {
    const Known& known = known_.at(cell + offset(b));
    const Int3 step = step_of(b);
    Vec3 from = from_centre;
    double square = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      from[a] -= static_cast<double>(step[a]);
      square += from[a] * from[a];
    }
    const double weight = 1 / (square + 1e-3);
    weights += weight;
    for (std::size_t c = 0; c < components; ++c)
      sum[c] += weight * (known.value[c] + from[0] * known.slope[0][c] + from[1] * known.slope[1][c] +
                          from[2] * known.slope[2][c]);
  };
  if (const auto alone = alone_.find(cell); alone != alone_.end()) {
    sum = alone->second;
    weights = 1;
  } else if (whole(cell)) {
    add(middle);
  } else {
    for (int b = 0; b < block; ++b)
      if (alike(cell, cell + offset(b))) add(b);
  }
  Value value;
  for (std::size_t v = 0; v < 6; ++v) {
    value.strain[v] = sum[v] / weights;
    value.stress[v] = sum[6 + v] / weights;
  }
  return value;
}

Vec3 SurfaceStress::middle_of_part(std::int64_t cell) const {
  const model::SurfaceCell* const cut = surface_cell(body_, cell);
  if (cut == nullptr) return {};
  const model::Moments& m = cut->moments;
  return (0.5 / m[0]) * Vec3{m[1], m[2], m[3]};
}

}  // namespace koshi::mechanics
