// Internal forces of the lattice: the one operator of motion, equilibrium, energies and reactions.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <vector>

#include "koshi/spring_lattice.h"
#include "mechanics/cell_sweep.h"
#include "mechanics/ground_forces.h"
#include "mechanics/plain_forces.h"

namespace koshi::mechanics {

class CutForces;

/// F = -K u for the springs of one lattice, which must outlive it, those to the ground among them. Shared springs go
/// cell by cell, each with its own material and factor; plain springs through the plain kernel. A node's force is
/// summed in the same order whatever rows are asked for, so its bits do not depend on the partition among ranks.
///
/// The material of a cell and its factor are read from the lattice every time: they may change between two calls, at no
/// cost but the change itself. The springs of the materials are read once, and so are the factors of plain springs.
class ForceKernel {
 public:
  explicit ForceKernel(const model::SpringLattice& lattice);
  ~ForceKernel();

  /// Calls use(j, k, force) for every one of the given rows of owned nodes: forces [N] and moments [N m] by component,
  /// pointers to node i = 0, valid until the next call; `use` may change them. Ghosts of `u` must be up to date. Calls
  /// release(j, k) for every one of these rows when the force on none of them needs its `u` any more: it may change.
  /// What `use` needs of fields of the lattice's layout may be fetched into the cache before: fetch(n) is called for
  /// nodes n, n + 1, ... on a line of 64 bytes.
  template <class Fetch, class Use, class Release>
  void for_each_row(const lattice::Field<double>& u, const Rows& rows, Fetch&& fetch, Use&& use, Release&& release) {
    using F = std::remove_reference_t<Fetch>;
    using U = std::remove_reference_t<Use>;
    using R = std::remove_reference_t<Release>;
    sweep(u, rows,
          {&fetch, &use, &release,
           [](void* f, std::int64_t n, std::int64_t end) {
             for (; n < end; n += lattice::Layout::lead) (*static_cast<F*>(f))(n);
           },
           [](void* f, std::int64_t j, std::int64_t k, double* const* force) { (*static_cast<U*>(f))(j, k, force); },
           [](void* f, std::int64_t j, std::int64_t k) { (*static_cast<R*>(f))(j, k); }});
  }
  /// The same for all owned rows, without fetch and release.
  template <class Use>
  void for_each_row(const lattice::Field<double>& u, Use&& use) {
    for_each_row(
        u, all_rows(), [](std::int64_t) {}, use, [](std::int64_t, std::int64_t) {});
  }

  /// force = -K u on all owned nodes; exchanges the ghosts of u on the way (collective).
  void apply(lattice::Field<double>& u, lattice::Field<double>& force);

  Rows all_rows() const { return {0, lattice_.layout.owned()[1], 0, lattice_.layout.owned()[2]}; }
  const model::SpringLattice& lattice() const { return lattice_; }
  int components() const { return components_; }
  /// Forces of the ground among those of the last call, for rows that it gave.
  const GroundForces& ground() const { return ground_; }

 private:
  /// References to the functions of for_each_row().
  struct Callbacks {
    void *fetch, *use, *release;
    void (*call_fetch)(void*, std::int64_t begin, std::int64_t end);
    void (*call_use)(void*, std::int64_t j, std::int64_t k, double* const* force);
    void (*call_release)(void*, std::int64_t j, std::int64_t k);
  };
  void sweep(const lattice::Field<double>& u, const Rows& rows, const Callbacks& callbacks);
  void plain_sweep(const lattice::Field<double>& u, const Rows& rows, const Callbacks& callbacks);
  const double* constants(std::int64_t i, std::int64_t j, std::int64_t k, std::int64_t cells, double* to);

  const model::SpringLattice& lattice_;
  int components_;
  CellSweep<double> sweep_;
  GroundForces ground_;
  std::vector<double> table_;  ///< constants by material
  /// What the constants of the strip at hand were made from.
  std::array<std::uint16_t, strip_cells> materials_{};
  std::array<float, strip_cells> factors_{};
  std::unique_ptr<CutForces> cut_;              ///< where surfaces cut cells
  std::unique_ptr<PlainForces> plain_;          ///< of plain springs
  std::vector<std::vector<double>> plain_row_;  ///< by component
};

}  // namespace koshi::mechanics
