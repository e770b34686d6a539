// Cracks of a body in motion: after each step, the cells that its displacements crack further, and the forces of closed
// crack faces.
#pragma once

#include <optional>
#include <vector>

#include "failure/cell_law.h"
#include "failure/crack_tracks.h"
#include "failure/fracturing.h"
#include "failure/strain_rows.h"
#include "koshi/model.h"
#include "mechanics/cell_stress.h"

namespace koshi::failure {

/// Rows of cells that touch an owned node, (-1, -1) first.
inline std::size_t cell_row(const lattice::Layout& layout, std::int64_t j, std::int64_t k) {
  return static_cast<std::size_t>((j + 1) + (layout.owned()[1] + 1) * (k + 1));
}

/// Keeps State::crack, State::face_force and the factors of the model's cells together. Every rank follows all cells
/// that touch its nodes, so that the bits do not depend on the ranks and no cracks are exchanged.
class Cracking : public Fracturing {
 public:
  /// Stiffness that broken cells keep in equilibrium, over that of whole ones. Nodes between them hang on it.
  static constexpr double trace = 1e-6;

  /// The model must have a material that can crack, and its cells their factors without cracks; it has those with the
  /// cracks of the state from then on.
  Cracking(model::Model& model, model::State& state);

  void restore() override;
  void follow(double dt) override;
  void look_again() override;

  /// Cells that have cracked with at least this damage (collective).
  std::int64_t count(double at_least) const;

  /// Raises the damage of owned cells to `wanted` where that is above what they have, with cracks of unit normal n;
  /// cells that have cracked keep their normal (collective). Throws InputError for a value outside 0 ... 1, or above 0
  /// in a cell that cannot crack.
  void damage_cells(const lattice::Field<double>& wanted, const Vec3& n);

 private:
  friend class CrackEvents;  // of the same cells, in equilibrium
  friend class CrackSteps;
  friend class ClosedFaces;
  /// Fills mean_ and radius_ for the row of cells (j, k), from i = -1 on.
  void look_at_row(std::int64_t j, std::int64_t k);
  void follow_row(std::int64_t j, std::int64_t k, double dt);
  void spend_reach(double dt);
  std::optional<Crack> begin(std::int64_t n, const Tensor6& strain) const;
  void crack_further(std::int64_t n, double dt);
  void take_begun();
  void restore_tracks();
  float factor(std::int64_t n, double damage) const;
  /// The part of a cell whose faces touch.
  double share(std::int64_t n, const Crack& crack) const {
    return crack.damage * static_cast<double>(whole_.component(0)[n]);
  }
  void set_factor(std::int64_t n, const Crack& crack);
  double stored_energy(std::int64_t n) const override;
  /// In equilibrium: broken cells keep a trace of their springs, and rows of cells pass by those that have cracked.
  void weaken(std::int64_t n, double of_damage);
  double intact_energy(std::int64_t n, double dt) const;
  void clear_faces();
  void close_faces(bool sliding);

  void slide(std::int64_t n, const Tensor6& strain, Crack& crack);

  Crack load(std::int64_t n) const;
  Crack load_faces(std::int64_t n) const;
  void store(std::int64_t n, const Crack& crack);
  const CellLaw& law(std::int64_t n) const { return *laws_[model_.lattice.cell.component(0)[n]]; }

  std::vector<std::optional<CellLaw>> laws_;  ///< by material index
  std::vector<Bound> bounds_;                 ///< by material index
  std::vector<double> per_strain_;            ///< by material index: the reach that a lacking strain of 1 gives [m]
  const StrainRows& rows_;
  std::vector<double> mean_, radius_;  ///< of a row
  lattice::Field<float> whole_;        ///< factors of the cells without cracks
  lattice::Field<float> limit_;        ///< equivalent strain below which a cell does not crack further
  CrackTracks tracks_;
  std::vector<char> breakable_;  ///< rows of cells with a material that can crack
  std::vector<double> reach_;    ///< of rows of cells: how far nodes may move before a cell can be at its limit [m]
  std::vector<double> moved_;    ///< of rows of nodes, (-1, -1) first: the longest way of a node in a step [m]
  std::vector<std::int64_t> cracked_;  ///< cracked cells, ascending
  std::vector<std::int64_t> begun_;    ///< cells whose cracks began in this step or event
  std::vector<std::int64_t> pressed_;  ///< of these, those whose faces carry something
};

}  // namespace koshi::failure
