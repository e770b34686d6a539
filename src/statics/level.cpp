#include "statics/level.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

namespace koshi::statics {

namespace {

// Of a second-level cache, the part that the values of a block of rows may fill [bytes].
constexpr std::int64_t cache = 768 * 1024;

// Are there cells below the first owned nodes in x? (Not where rows of the body are whole.)
bool cells_below(const LevelGrid& grid) { return grid.halo->layout().begin()[0] > 0 || grid.grid.periodic[0]; }

}  // namespace

bool LevelGrid::can_coarsen() const {
  for (int a = 0; a < 3; ++a) {
    const auto& borders = partition->borders[a];
    for (std::size_t p = 1; p + 1 < borders.size(); ++p)
      if (borders[p] % 2 != 0) return false;
  }
  return true;
}

LevelGrid LevelGrid::coarsened() const {
  LevelGrid coarse;
  coarse.grid = grid;
  coarse.grid.d *= 2;
  auto merged = std::make_shared<lattice::Partition>(*partition);
  for (int a = 0; a < 3; ++a) {
    coarse.grid.cells[a] = (grid.cells[a] + 1) / 2;
    for (std::int64_t& border : merged->borders[a]) border /= 2;
    merged->borders[a].back() = coarse.grid.nodes()[a];
  }
  coarse.halo = std::make_shared<const lattice::Halo>(coarse.grid, *merged, halo->communicator());
  coarse.partition = std::move(merged);
  return coarse;
}

bool ends_odd_period(const LevelGrid& grid, int axis) {
  if (!grid.grid.periodic[axis] || grid.grid.cells[axis] % 2 == 0) return false;
  const lattice::Layout& box = grid.halo->layout();
  return box.begin()[axis] + box.owned()[axis] == grid.grid.cells[axis];
}

RowField<float> coarsened(const RowField<float>& constants, const LevelGrid& fine_grid, const LevelGrid& coarse) {
  const Int3 &fine = constants.owned(), &owned = coarse.owned();
  RowField<float> result(owned, constants.components());
  // The layer that is not there: the last one once more, or nothing. (A period of one cell stays as thick as it is.)
  std::array<bool, 3> repeats;
  for (int a = 0; a < 3; ++a) repeats[a] = fine_grid.grid.cells[a] > 1 && ends_odd_period(fine_grid, a);
  for (std::int64_t k = 0; k < owned[2]; ++k)
    for (std::int64_t j = 0; j < owned[1]; ++j)
      for (int q = 0; q < constants.components(); ++q) {
        float* const to = result.row(j, k) + q * result.pitch();
        for (int r = 0; r < 4; ++r) {
          std::int64_t fine_j = 2 * j + (r & 1), fine_k = 2 * k + (r >> 1);
          if (repeats[1]) fine_j = std::min(fine_j, fine[1] - 1);
          if (repeats[2]) fine_k = std::min(fine_k, fine[2] - 1);
          if (fine_j >= fine[1] || fine_k >= fine[2]) continue;
          const float* const from = constants.row(fine_j, fine_k) + q * constants.pitch();
          for (std::int64_t i = 0; i < owned[0]; ++i) {
            to[i] += 0.25f * from[2 * i];
            if (2 * i + 1 < fine[0])
              to[i] += 0.25f * from[2 * i + 1];
            else if (repeats[0])
              to[i] += 0.25f * from[2 * i];
          }
        }
      }
  result.exchange(*coarse.halo);
  return result;
}

Level::Level(LevelGrid grid, int components, RowField<float> constants, FixedNodes fixed, SurfaceTerms* surface)
    : grid_(std::move(grid)),
      components_(components),
      fixed_(std::move(fixed)),
      springs_(std::move(constants), surface == nullptr),
      blocks_(springs_, fixed_, components,
              surface != nullptr ? surface->node_blocks() : std::vector<mechanics::CutForces::NodeBlock>{}),
      b(grid_.owned(), components),
      x(grid_.owned(), components),
      surface_(surface),
      y_(grid_.owned(), components),
      sweep_(components, grid_.owned()[0], grid_.owned()[1], cells_below(grid_), 1, cache),
      line_({grid_.owned()[0] + 1, 0, 0}, 1) {
  std::ranges::copy_if(fixed_, std::back_inserter(sprung_), &FixedNode::sprung);
  if (sprung_.empty()) return;
  std::size_t at = 0;
  for (std::int64_t row = 0; row < grid_.owned()[1] * grid_.owned()[2]; ++row) {
    sprung_of_row_.push_back(at);
    while (at < sprung_.size() && sprung_[at].node[1] + grid_.owned()[1] * sprung_[at].node[2] == row) ++at;
  }
  sprung_of_row_.push_back(at);
}

void Level::add_springs(std::int64_t j, std::int64_t k, float* const* force) {
  if (sprung_.empty()) return;
  const auto row = static_cast<std::size_t>(j + grid_.owned()[1] * k);
  for (std::size_t s = sprung_of_row_[row]; s < sprung_of_row_[row + 1]; ++s) {
    const std::int64_t i = sprung_[s].node[0];
    for (int c = 0; c < 3; ++c)
      for (int e = 0; e < 3; ++e) force[c][i] -= sprung_[s].stiffness(c, e) * x.row(j, k)[e * x.pitch() + i];
  }
}

mechanics::RelaxRow Level::relax_row(std::int64_t j, std::int64_t k, const float* force) {
  return {b.row(j, k),       x.row(j, k),       y_.row(j, k),     b.pitch(),       force,           sweep_.pitch(),
          blocks_.row(j, k), blocks_.uniform(), blocks_.blocks(), blocks_.units(), grid_.owned()[0]};
}

template <class F>
void Level::for_each_row(F&& use) {
  const Int3& owned = grid_.owned();
  x.exchange(*grid_.halo);
  // The strip whose constants were prepared last.
  std::int32_t last_row = -1;
  std::int64_t last_i = 0;
  const auto constants = [&](std::int64_t i, std::int64_t j, std::int64_t k, std::int64_t cells,
                             float* to) -> const float* {
    const std::int32_t row = springs_.row(j, k);
    const auto [first, last] = springs_.span(row);
    if (last <= i || i + cells <= first) return nullptr;
    if (row != last_row || i != last_i) springs_.prepare(row, i, cells, to);
    last_row = row;
    last_i = i;
    return to;
  };
  const mechanics::NodeValues<float> values{x.row(0, 0), x.pitch(), x.row(1, 0) - x.row(0, 0),
                                            x.row(0, 1) - x.row(0, 0)};
  const mechanics::Rows rows{0, owned[1], 0, owned[2]};
  if (surface_ != nullptr) surface_->update(values, rows);
  sweep_.run(
      values, rows, constants,
      [&](std::int64_t i, std::int64_t j, std::int64_t k, std::int64_t nodes) {
        if (blocks_.row(j, k) == nullptr) return;
        b.fetch(i, j, k, nodes);
        y_.fetch(i, j, k, nodes);
      },
      [&](std::int64_t j, std::int64_t k, float* const* force) {
        if (blocks_.row(j, k) == nullptr) return;
        add_springs(j, k, force);
        if (surface_ != nullptr) surface_->add(j, k, force);
        use(j, k, relax_row(j, k, force[0]));
      },
      [](std::int64_t, std::int64_t) {});
}

void Level::relax(int degree, double bound, bool from_zero) {
  const auto& kernels = mechanics::relax_kernels();
  const auto c = [&](int step) { return static_cast<float>((8 * step - 4) / ((2 * step + 1) * bound)); };
  for (int step = 1; step <= degree; ++step) {
    if (step == 1 && from_zero) {
      for (std::int64_t k = 0; k < grid_.owned()[2]; ++k)
        for (std::int64_t j = 0; j < grid_.owned()[1]; ++j)
          if (blocks_.row(j, k) != nullptr) kernels.relax_zero(relax_row(j, k, nullptr), components_, c(1));
    } else {
      // y holds the step before; before the first there is none, or x = 0.
      const float a = static_cast<float>(2 * step - 3) / static_cast<float>(2 * step + 1);
      const float p = step == 1 ? 1 : 1 + a;
      const float q = step == 1 || (step == 2 && from_zero) ? 0 : -a;
      for_each_row([&](std::int64_t, std::int64_t, const mechanics::RelaxRow& row) {
        kernels.relax(row, components_, p, q, c(step));
      });
    }
    std::swap(x, y_);
  }
}

void Level::make_image(RowField<float>& v) {
  std::swap(x, v);
  for_each_row([&](std::int64_t, std::int64_t, const mechanics::RelaxRow& row) {
    for (int c = 0; c < components_; ++c)
      for (std::int64_t i = 0; i < row.count; ++i) row.y[c * row.pitch + i] = -row.force[c * row.force_pitch + i];
  });
  std::swap(x, v);
  clear_fixed(fixed_, y_);
}

double Level::stretch(int steps) {
  // Without symmetry, and the same on any ranks.
  const Int3& n = grid_.owned();
  const auto each = [&](RowField<float>& field, auto&& f) {
    for (std::int64_t k = 0; k < n[2]; ++k)
      for (std::int64_t j = 0; j < n[1]; ++j)
        for (int c = 0; c < components_; ++c)
          for (std::int64_t i = 0; i < n[0]; ++i) f(field.row(j, k)[c * field.pitch() + i], Int3{i, j, k}, c);
  };
  b.zero();
  each(x, [&](float& value, const Int3& node, int c) {
    const Int3 g = grid_.halo->layout().global(node);
    auto h = static_cast<std::uint64_t>(c + 6 * (g[0] + 1000003 * (g[1] + 1000003 * g[2]))) + 0x9e3779b97f4a7c15ULL;
    h = (h ^ h >> 30) * 0xbf58476d1ce4e5b9ULL;
    h = (h ^ h >> 27) * 0x94d049bb133111ebULL;
    value = static_cast<float>((h ^ h >> 31) >> 40) * 0x1p-23f - 1;
  });
  double grown = 0;
  for (int step = 0; step < steps; ++step) {
    // y = B K x.
    for_each_row([&](std::int64_t, std::int64_t, const mechanics::RelaxRow& row) {
      mechanics::relax_kernels().relax(row, components_, 0, 0, -1);
    });
    float largest = 0;
    each(y_, [&](float& value, const Int3&, int) { largest = std::max(largest, std::abs(value)); });
    grown = grid_.halo->communicator().max(static_cast<double>(largest));
    if (!(grown > 0)) break;
    each(y_, [&](float& value, const Int3&, int) { value = static_cast<float>(value / grown); });
    std::swap(x, y_);
  }
  x.zero();
  y_.zero();
  return grown;
}

// A node on a coarse one gives all it has to that one, also beyond the border of an odd period.
void Level::clear_ghosts_of_odd_periods() {
  const Int3& n = grid_.owned();
  const auto clear = [&](const Int3& lo, const Int3& hi) {
    for (std::int64_t k = lo[2]; k <= hi[2]; ++k)
      for (std::int64_t j = lo[1]; j <= hi[1]; ++j)
        for (int c = 0; c < components_; ++c)
          std::fill_n(y_.row(j, k) + c * y_.pitch() + lo[0], hi[0] - lo[0] + 1, 0.0f);
  };
  for (int a = 0; a < 3; ++a) {
    if (!grid_.grid.periodic[a] || grid_.grid.cells[a] % 2 == 0) continue;
    Int3 lo{-1, -1, -1}, hi = n;
    if (grid_.halo->layout().begin()[a] == 0) {
      hi[a] = -1;
      clear(lo, hi);
    }
    if (!ends_odd_period(grid_, a)) continue;
    lo[a] = hi[a] = n[a];
    clear(lo, hi);
  }
}

void Level::restrict_residual(Level& coarse) {
  const auto& kernels = mechanics::relax_kernels();
  for_each_row([&](std::int64_t, std::int64_t, const mechanics::RelaxRow& row) { kernels.residual(row, components_); });
  clear_fixed(fixed_, y_);
  y_.exchange(*grid_.halo);
  clear_ghosts_of_odd_periods();

  const Int3 &fine = grid_.owned(), &owned = coarse.grid_.owned();
  float* const line = line_.row(0, 0);
  for (std::int64_t K = 0; K < owned[2]; ++K)
    for (std::int64_t J = 0; J < owned[1]; ++J) {
      // The up to nine rows around the coarse one; nodes beyond the ghosts do not exist.
      std::array<const float*, 9> rows;
      std::array<float, 9> weights;
      int count = 0;
      for (std::int64_t k = 2 * K - 1; k <= std::min(2 * K + 1, fine[2]); ++k)
        for (std::int64_t j = 2 * J - 1; j <= std::min(2 * J + 1, fine[1]); ++j) {
          rows[static_cast<std::size_t>(count)] = y_.row(j, k);
          weights[static_cast<std::size_t>(count++)] = (j == 2 * J ? 1.0f : 0.5f) * (k == 2 * K ? 1.0f : 0.5f);
        }
      for (int c = 0; c < components_; ++c) {
        kernels.combine(line, rows.data(), weights.data(), count, fine[0] + 1);
        line[fine[0] + 1] = 0;
        kernels.restrict_(coarse.b.row(J, K) + c * coarse.b.pitch(), line, c < 3 ? 1.0f : 0.5f, owned[0]);
        for (int r = 0; r < count; ++r) rows[static_cast<std::size_t>(r)] += y_.pitch();
      }
    }
  clear_fixed(coarse.fixed_, coarse.b);
}

void Level::add_correction(Level& coarse) {
  const auto& kernels = mechanics::relax_kernels();
  RowField<float>& e = coarse.x;
  e.exchange(*coarse.grid_.halo);
  float* const line = line_.row(0, 0);
  for (std::int64_t k = 0; k < grid_.owned()[2]; ++k)
    for (std::int64_t j = 0; j < grid_.owned()[1]; ++j) {
      if (blocks_.row(j, k) == nullptr) continue;
      // The mean of the one, two or four coarse rows around the fine one.
      std::array<const float*, 4> rows;
      int count = 0;
      for (std::int64_t K = k / 2; K <= (k + 1) / 2; ++K)
        for (std::int64_t J = j / 2; J <= (j + 1) / 2; ++J) rows[static_cast<std::size_t>(count++)] = e.row(J, K);
      std::array<float, 4> weights;
      weights.fill(1.0f / static_cast<float>(count));
      for (int c = 0; c < components_; ++c) {
        kernels.combine(line, rows.data(), weights.data(), count, coarse.grid_.owned()[0] + 1);
        kernels.prolong(x.row(j, k) + c * x.pitch(), line, c < 3 ? 1.0f : 0.5f, grid_.owned()[0]);
        for (int r = 0; r < count; ++r) rows[static_cast<std::size_t>(r)] += e.pitch();
      }
    }
  clear_fixed(fixed_, x);
}

}  // namespace koshi::statics
