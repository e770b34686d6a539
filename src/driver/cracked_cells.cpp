#include "driver/cracked_cells.h"

#include <algorithm>
#include <cstring>
#include <string>
#include <type_traits>

#include "failure/principal.h"
#include "failure/softening.h"
#include "mechanics/cell_stress.h"

namespace koshi::driver {
namespace {

// Components of State::crack.
constexpr int damage = 0, kappa = 1, normal = 6, dissipated = 12, shear = 14;

Vec3 normal_of(const model::State& state, std::int64_t n) {
  return {state.crack.component(normal)[n], state.crack.component(normal + 1)[n], state.crack.component(normal + 2)[n]};
}

}  // namespace

double crack_opening(const model::Model& model, const model::State& state, std::int64_t n) {
  if (state.crack.component(kappa)[n] == 0) return 0;
  const Vec3 across = normal_of(state, n);
  const double strain = failure::along(mechanics::cell_strain(model.lattice, state.displacement, n), across);
  return state.crack.component(damage)[n] * failure::band_width(model.lattice.grid.d, across) * std::max(strain, 0.0);
}

std::vector<CrackedCell> cracked_cells(const model::Model& model, const model::State& state) {
  static_assert(std::is_trivially_copyable_v<CrackedCell>);
  const Int3& cells = model.lattice.grid.cells;
  std::string own;
  lattice::for_each_owned(model.layout(), [&](auto i, auto j, auto k, auto n) {
    if (state.crack.component(damage)[n] < model::parted) return;
    const Int3 at = model.layout().global({i, j, k});
    const CrackedCell cell{at[0] + cells[0] * (at[1] + cells[1] * at[2]),
                           state.crack.component(model::crack_moment)[n],
                           state.crack.component(damage)[n],
                           crack_opening(model, state, n),
                           state.crack.component(dissipated)[n],
                           state.crack.component(shear)[n],
                           normal_of(state, n)};
    own.append(reinterpret_cast<const char*>(&cell), sizeof cell);
  });
  const std::string bytes = model.communicator.gather(own);
  std::vector<CrackedCell> all(bytes.size() / sizeof(CrackedCell));
  if (!all.empty()) std::memcpy(all.data(), bytes.data(), bytes.size());
  std::ranges::sort(all, {}, &CrackedCell::number);
  return all;
}

}  // namespace koshi::driver
