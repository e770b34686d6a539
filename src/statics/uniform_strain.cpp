#include "statics/uniform_strain.h"

#include <array>

#include "base/exact_sum.h"

namespace koshi::statics {

void add_uniform_strain(const model::Model& model, const mechanics::Tensor6& strain, lattice::Field<double>& u) {
  const auto& [xx, yy, zz, yz, xz, xy] = strain;
  const std::array<Vec3, 3> rows{Vec3{xx, xy, xz}, Vec3{xy, yy, yz}, Vec3{xz, yz, zz}};
  const lattice::Layout& layout = model.layout();
  const Int3& owned = layout.owned();
  lattice::for_each(layout, {-1, -1, -1}, {owned[0] + 1, owned[1] + 1, owned[2] + 1},
                    [&](auto i, auto j, auto k, auto n) {
                      // Global numbers, so that all ranks give a node the same displacement.
                      const Int3 global = layout.global({i, j, k});
                      const double d = model.lattice.grid.d;
                      const Vec3 x{d * static_cast<double>(global[0]), d * static_cast<double>(global[1]),
                                   d * static_cast<double>(global[2])};
                      for (int c = 0; c < 3; ++c) u.component(c)[n] += dot(rows[static_cast<std::size_t>(c)], x);
                    });
}

mechanics::Tensor6 mean_stress(const model::Model& model, const lattice::Field<double>& u) {
  const model::SpringLattice& body = model.lattice;
  std::array<ExactSum, 6> sums;
  lattice::for_each_owned(body.layout, [&](auto, auto, auto, auto n) {
    if (body.cell.component(0)[n] == 0) return;
    const mechanics::Tensor6 stress = mechanics::cell_state(body, u, n).stress;
    for (std::size_t v = 0; v < 6; ++v) sums[v] += stress[v];
  });
  sum_ranks(sums, model.communicator);
  mechanics::Tensor6 mean;
  for (std::size_t v = 0; v < 6; ++v) mean[v] = sums[v].value() / static_cast<double>(body.grid.cell_count());
  return mean;
}

}  // namespace koshi::statics
