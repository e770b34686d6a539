#include "homogenize/bounds.h"

#include <algorithm>
#include <array>
#include <limits>

#include "base/exact_sum.h"
#include "homogenize/cells.h"

namespace koshi::homogenize {
namespace {

Moduli moduli_of(const model::Model& model, std::int64_t cell) {
  const std::uint16_t material = model.lattice.cell.component(0)[cell];
  if (material == 0) return {};
  const material::Elastic& elastic = model.materials[material];
  const double factor = model.lattice.factor_of(cell);
  return {factor * (elastic.lambda() + 2 * elastic.mu() / 3), factor * elastic.mu()};
}

// Shear modulus that takes the place of G in the mean of shear moduli.
double partner(const Moduli& m) {
  return m.bulk + 2 * m.shear > 0 ? m.shear / 6 * (9 * m.bulk + 8 * m.shear) / (m.bulk + 2 * m.shear) : 0;
}

// 1 / <1 / (x + z)> - z over all cells, the mean that all the bounds are.
class Means {
 public:
  void add(const Moduli& m) {
    for (std::size_t s = 0; s < shifts.size(); ++s) {
      sums_[2 * s] += 1 / (m.bulk + shifts[s].bulk);
      sums_[2 * s + 1] += 1 / (m.shear + shifts[s].shear);
    }
  }
  void sum_ranks(const Communicator& communicator) { koshi::sum_ranks(sums_, communicator); }
  Moduli mean(std::size_t s, double cells) const {
    return {of(sums_[2 * s], shifts[s].bulk, cells), of(sums_[2 * s + 1], shifts[s].shear, cells)};
  }
  std::array<Moduli, 3> shifts;

 private:
  static double of(const ExactSum& sum, double shift, double cells) {
    return std::max(0.0, cells / sum.value() - shift);
  }
  std::array<ExactSum, 6> sums_;
};

}  // namespace

Bounds find_bounds(const model::Model& model) {
  const Communicator& communicator = model.communicator;
  Moduli most, least{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  std::array<ExactSum, 2> whole;
  const auto for_each_moduli = [&](auto&& use) {
    for_each_cell(model, [&](std::int64_t n) { use(moduli_of(model, n)); });
  };
  for_each_moduli([&](const Moduli& m) {
    most = {std::max(most.bulk, m.bulk), std::max(most.shear, m.shear)};
    least = {std::min(least.bulk, m.bulk), std::min(least.shear, m.shear)};
    whole[0] += m.bulk;
    whole[1] += m.shear;
  });
  most = {communicator.max(most.bulk), communicator.max(most.shear)};
  least = {communicator.min(least.bulk), communicator.min(least.shear)};
  sum_ranks(whole, communicator);

  // Without stiffness somewhere the harmonic means are zero.
  const bool solid = least.bulk > 0 && least.shear > 0;
  Means means;
  means.shifts = {Moduli{0, 0}, Moduli{4 * least.shear / 3, partner(least)}, Moduli{4 * most.shear / 3, partner(most)}};
  for_each_moduli([&](const Moduli& m) { means.add(m); });
  means.sum_ranks(communicator);
  const auto cells = static_cast<double>(model.lattice.grid.cell_count());
  Bounds bounds;
  bounds.voigt = {whole[0].value() / cells, whole[1].value() / cells};
  bounds.hashin_upper = means.mean(2, cells);
  if (solid) {
    bounds.reuss = means.mean(0, cells);
    bounds.hashin_lower = means.mean(1, cells);
  }
  return bounds;
}

}  // namespace koshi::homogenize
