// One level of the multigrid hierarchy.
#pragma once

#include <memory>
#include <vector>

#include "koshi/grid.h"
#include "lattice/halo.h"
#include "lattice/partition.h"
#include "mechanics/cell_sweep.h"
#include "statics/fixed_nodes.h"
#include "statics/node_blocks.h"
#include "statics/spring_rows.h"
#include "statics/surface_terms.h"

namespace koshi::statics {

/// A level's box of cells on the ranks.
struct LevelGrid {
  lattice::Grid grid;
  std::shared_ptr<const lattice::Partition> partition;
  std::shared_ptr<const lattice::Halo> halo;

  const Int3& owned() const { return halo->layout().owned(); }
  /// Can 2x2x2 cells be merged without crossing ranks?
  bool can_coarsen() const;
  /// Cells merged 2x2x2. An odd number of cells is padded at the upper side: with an empty layer, in a periodic
  /// direction with a copy of the last one. There the coarse body has a period one fine cell longer, for the nodes 0
  /// and n - 1 both lie on coarse ones; the springs across that layer come out half as stiff as they are, those along
  /// it twice.
  LevelGrid coarsened() const;
};

/// Whether the rank's last layer of cells along `axis` ends an odd period: nodes next to each other across that border
/// both lie on coarse nodes.
bool ends_odd_period(const LevelGrid& grid, int axis);

/// Constants of merged cells, the mean of eight cells at twice the spacing: a quarter of their sum (springs grow with
/// the spacing). Ghosts included (collective).
RowField<float> coarsened(const RowField<float>& constants, const LevelGrid& fine, const LevelGrid& coarse);

/// The stiffness K of one level, in single precision, with relaxation. Fixed components and nodes without a cell stay
/// zero; all functions are collective.
class Level {
  LevelGrid grid_;
  int components_;
  FixedNodes fixed_;
  // The springs come before the fields: what they are made from is free again when those take their memory.
  SpringRows springs_;
  NodeBlocks blocks_;

 public:
  /// `surface`: what cells at surfaces add, on the finest level; must outlive it.
  Level(LevelGrid grid, int components, RowField<float> constants, FixedNodes fixed, SurfaceTerms* surface = nullptr);

  /// x += polynomial(B K) B (b - K x): `degree` steps of Chebyshev's iteration of the fourth kind for eigenvalues of
  /// B K up to `bound` (J. Lottes, doi:10.1002/nla.2535), which needs no lower bound. `from_zero`: x is taken as zero.
  void relax(int degree, double bound, bool from_zero);
  /// image() = K v on free components; fills the ghosts of v. Relaxation and transfer use the memory of the image.
  void make_image(RowField<float>& v);
  const RowField<float>& image() const { return y_; }
  /// The largest eigenvalue of B K, from below within some per cent: by how much `steps` applications stretch a vector.
  double stretch(int steps);
  /// Right-hand side of the next coarser level: its b = P^T (b - K x), P the trilinear interpolation of all components
  /// (rho = (d/2) w halves from a level to the next finer one).
  void restrict_residual(Level& coarse);
  /// x += P e with the coarser level's solution e.
  void add_correction(Level& coarse);

  const LevelGrid& grid() const { return grid_; }
  const SpringRows& springs() const { return springs_; }
  const FixedNodes& fixed() const { return fixed_; }
  int components() const { return components_; }

  RowField<float> b;  ///< right-hand side, zero on fixed components
  RowField<float> x;

 private:
  /// Runs over all rows of owned nodes: use(j, k, row) gets the row with its forces -K x.
  template <class F>
  void for_each_row(F&& use);
  void clear_ghosts_of_odd_periods();
  /// Adds the forces of springs that hold nodes of row (j, k), force[c] pointing to node i = 0.
  void add_springs(std::int64_t j, std::int64_t k, float* const* force);
  mechanics::RelaxRow relax_row(std::int64_t j, std::int64_t k, const float* force);

  FixedNodes sprung_;                       ///< those with springs
  std::vector<std::size_t> sprung_of_row_;  ///< the first of each row, and the end; empty: none anywhere
  SurfaceTerms* surface_;
  RowField<float> y_;
  mechanics::CellSweep<float> sweep_;
  RowField<float> line_;  ///< one component of a row, for transfers
};

}  // namespace koshi::statics
