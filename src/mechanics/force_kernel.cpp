#include "mechanics/force_kernel.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "lattice/halo.h"
#include "mechanics/cell_table.h"
#include "mechanics/cut_forces.h"
#include "mechanics/strain_tie.h"

namespace koshi::mechanics {
namespace {

using model::SpringLattice;

// Of a second-level cache, the part that the values of a block of rows may fill [bytes].
constexpr std::int64_t cache = 768 * 1024;

// Cells whose constants are made at a time; a strip has a multiple of them, and a vector has no more.
constexpr std::int64_t few = lattice::Layout::lead;
static_assert(strip_cells % few == 0);

// Are there cells below the first owned nodes in x? (Not where rows of the body are whole.)
bool cells_below(const SpringLattice& body) { return body.layout.begin()[0] > 0 || body.grid.periodic[0]; }

}  // namespace

ForceKernel::ForceKernel(const SpringLattice& lattice)
    : lattice_(lattice),
      components_(lattice.components()),
      sweep_(components_, lattice.layout.owned()[0], lattice.layout.owned()[1], cells_below(lattice),
             0.5 * lattice.grid.d, cache),
      ground_(lattice) {
  if (lattice.sharing == material::Sharing::plain) {
    plain_ = std::make_unique<PlainForces>(lattice);
    plain_row_.assign(static_cast<std::size_t>(components_),
                      std::vector<double>(static_cast<std::size_t>(lattice.layout.owned()[0] + lattice::Layout::lead)));
    return;
  }
  materials_.fill(std::numeric_limits<std::uint16_t>::max());  // of no material: nothing is made yet
  if (!lattice.surface.empty()) cut_ = std::make_unique<CutForces>(lattice);
  for (const material::Springs& springs : lattice.springs) {
    const auto constants = springs_of_cell(springs, lattice.grid.d);
    table_.insert(table_.end(), constants.begin(), constants.end());
    table_.resize((table_.size() + table_constants - 1) / table_constants * table_constants, 0.0);
  }
}

ForceKernel::~ForceKernel() = default;

// Constants of a strip of cells; of those that are as they were in the last strip nothing needs to be made.
const double* ForceKernel::constants(std::int64_t i, std::int64_t j, std::int64_t k, std::int64_t cells, double* to) {
  const std::int64_t n = lattice_.layout.index(i, j, k);
  const std::uint16_t* const material = lattice_.cell.component(0) + n;
  const float* const factor = lattice_.factor.components() == 0 ? nullptr : lattice_.factor.component(0) + n;
  // The next row of the strip is fetched on the way.
  __builtin_prefetch(material + lattice_.layout.pitch(), 0, 2);
  if (factor != nullptr)
    for (std::int64_t c = 0; c < cells; c += 2 * few) __builtin_prefetch(factor + lattice_.layout.pitch() + c, 0, 2);
  const std::size_t material_bytes = static_cast<std::size_t>(cells) * sizeof *material;
  const std::size_t factor_bytes = static_cast<std::size_t>(cells) * sizeof *factor;
  static constexpr std::array<std::uint16_t, strip_cells> none{};
  if (std::memcmp(material, none.data(), material_bytes) == 0) return nullptr;
  const bool known = std::memcmp(material, materials_.data(), material_bytes) == 0 &&
                     (factor == nullptr || std::memcmp(factor, factors_.data(), factor_bytes) == 0);
  if (known) return to;
  // Few cells of a strip differ from those of the last one where some have cracked.
  for (std::int64_t c = 0; c < cells; c += few) {
    const auto at = static_cast<std::size_t>(c);
    if (std::memcmp(material + c, &materials_[at], few * sizeof *material) == 0 &&
        (factor == nullptr || std::memcmp(factor + c, &factors_[at], few * sizeof *factor) == 0))
      continue;
    std::memcpy(&materials_[at], material + c, few * sizeof *material);
    if (factor != nullptr) std::memcpy(&factors_[at], factor + c, few * sizeof *factor);
    strip_kernels<double>().prepare(material + c, factor == nullptr ? nullptr : factor + c, table_.data(),
                                    strain_is_tied(lattice_) ? 1 : 0, few, to + c);
  }
  return to;
}

void ForceKernel::sweep(const lattice::Field<double>& u, const Rows& rows, const Callbacks& callbacks) {
  ground_.update(u, rows);
  if (plain_) return plain_sweep(u, rows, callbacks);
  const lattice::Layout& layout = lattice_.layout;
  const NodeValues<double> values{u.component(0) + layout.index(0, 0, 0), u.stride(), layout.pitch(), layout.plane()};
  if (cut_) cut_->update(values, rows);
  sweep_.run(
      values, rows, [this](auto i, auto j, auto k, auto cells, double* to) { return constants(i, j, k, cells, to); },
      [&](auto i, auto j, auto k, auto nodes) {
        const std::int64_t n = layout.index(i, j, k);
        callbacks.call_fetch(callbacks.fetch, n, n + nodes);
      },
      [&](auto j, auto k, double* const* force) {
        ground_.add(j, k, force);
        if (cut_) cut_->add(j, k, force);
        callbacks.call_use(callbacks.use, j, k, force);
      },
      [&](auto j, auto k) { callbacks.call_release(callbacks.release, j, k); });
}

void ForceKernel::plain_sweep(const lattice::Field<double>& u, const Rows& rows, const Callbacks& callbacks) {
  std::array<double*, 6> force{};
  for (int c = 0; c < components_; ++c) force[c] = plain_row_[c].data();
  const auto for_each = [&rows](auto&& f) {
    for (std::int64_t k = rows.k0; k < rows.k1; ++k)
      for (std::int64_t j = rows.j0; j < rows.j1; ++j) f(j, k);
  };
  for_each([&](std::int64_t j, std::int64_t k) {
    plain_->row(u, j, k, force.data());
    ground_.add(j, k, force.data());
    callbacks.call_use(callbacks.use, j, k, force.data());
  });
  for_each([&](std::int64_t j, std::int64_t k) { callbacks.call_release(callbacks.release, j, k); });
}

void ForceKernel::apply(lattice::Field<double>& u, lattice::Field<double>& force) {
  lattice_.halo->exchange(u);
  const std::size_t bytes = static_cast<std::size_t>(lattice_.layout.owned()[0]) * sizeof(double);
  for_each_row(u, [&](std::int64_t j, std::int64_t k, double* const* f) {
    for (int c = 0; c < components_; ++c) std::memcpy(force.component(c) + lattice_.layout.index(0, j, k), f[c], bytes);
  });
}

}  // namespace koshi::mechanics
