#include "homogenize/phase_sums.h"

#include <algorithm>
#include <array>

#include "base/lane_sum.h"
#include "homogenize/cells.h"
#include "lattice/halo.h"
#include "lattice/partition.h"
#include "mechanics/corners.h"
#include "mechanics/uniform_strain.h"

namespace koshi::homogenize {
namespace {

// A cell of the body by itself, whose material may be changed.
model::SpringLattice one_cell(const model::SpringLattice& body) {
  lattice::Grid grid = body.grid;
  grid.cells = {1, 1, 1};
  grid.periodic = {};
  const auto partition = std::make_shared<const lattice::Partition>(lattice::make_partition(grid, 1));
  const auto halo = std::make_shared<const lattice::Halo>(grid, *partition, Communicator::self());
  model::SpringLattice cell = model::make_cells(grid, partition, halo, [](const Int3&) { return std::uint16_t{1}; });
  cell.sharing = body.sharing;
  cell.kinematics = body.kinematics;
  cell.springs = body.springs;
  return cell;
}

}  // namespace

PhaseSums::PhaseSums(const model::Model& model, const std::vector<Phase>& phases)
    : model_(model), single_(one_cell(model.lattice)) {
  constexpr std::size_t most = 100;
  if (phases.size() > most) return;
  slot_.resize(model.materials.size());
  for (const Phase& phase : phases) {
    if (phase.material == 0) continue;
    slot_[phase.material] = means_.size();
    means_.push_back({phase.material, {}, {}});
    cells_.push_back(phase.fraction * static_cast<double>(model.lattice.grid.cell_count()));
  }
}

void PhaseSums::add_run(const lattice::Field<double>& u, std::int64_t n, std::int64_t count, bool weighted,
                        std::vector<ExactSum>& sums, std::size_t at) const {
  const float* const factor = weighted ? model_.lattice.factor.component(0) + n : nullptr;
  for (int a = 0; a < 8; ++a) {
    const std::int64_t node = n + model_.layout().offset(mechanics::corner(a));
    for (int c = 0; c < u.components(); ++c) {
      const double* const values = u.component(c) + node;
      sums[at + static_cast<std::size_t>(6 * a + c)] +=
          factor == nullptr
              ? lane_sum<8>(count, [&](std::int64_t i) { return values[i]; })
              : lane_sum<8>(count, [&](std::int64_t i) { return static_cast<double>(factor[i]) * values[i]; });
    }
  }
}

mechanics::Tensor6 PhaseSums::add(std::size_t j, const lattice::Field<double>& u) {
  if (means_.empty()) return mechanics::mean_stress(model_, u);
  const model::SpringLattice& body = model_.lattice;
  const std::uint16_t* const cell = body.cell.component(0);
  const bool weighted = body.factor.components() != 0;
  // Of each phase: motions times factors, and the motions as they are where factors differ from 1.
  const std::size_t sets = weighted ? 2 : 1;
  std::vector<ExactSum> sums(means_.size() * sets * motions);
  std::int64_t first = -1, next = -1;
  const auto close = [&] {
    if (first < 0 || cell[first] == 0) return;
    const std::size_t at = slot_[cell[first]] * sets * motions;
    add_run(u, first, next - first, weighted, sums, at);
    if (weighted) add_run(u, first, next - first, false, sums, at + motions);
  };
  for_each_cell(model_, [&](std::int64_t n) {
    if (n != next || cell[n] != cell[first]) {
      close();
      first = n;
    }
    next = n + 1;
  });
  close();
  sum_ranks(sums, model_.communicator);

  // The mean cell of each phase.
  mechanics::Tensor6 stress{};
  const std::int64_t index = single_.layout.index(0, 0, 0);
  for (std::size_t p = 0; p < means_.size(); ++p) {
    single_.cell.component(0)[index] = means_[p].material;
    const auto state = [&](std::size_t set) {
      mechanics::CellMotion motion;
      for (std::size_t a = 0; a < 8; ++a)
        for (std::size_t c = 0; c < 3; ++c) {
          const std::size_t at = (p * sets + set) * motions + 6 * a + c;
          motion.displacement[a][c] = sums[at].value() / cells_[p];
          motion.rotation[a][c] = sums[at + 3].value() / cells_[p];
        }
      return mechanics::cell_state(single_, motion, index);
    };
    const mechanics::Tensor6 of_phase = state(0).stress, strain = state(sets - 1).strain;
    for (std::size_t v = 0; v < 6; ++v) {
      means_[p].stress[v][j] = of_phase[v];
      means_[p].strain[v][j] = (v < 3 ? 1 : 2) * strain[v];
      stress[v] += of_phase[v] * cells_[p] / static_cast<double>(body.grid.cell_count());
    }
  }
  return stress;
}

}  // namespace koshi::homogenize
