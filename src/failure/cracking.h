// Cracks of a body in motion: after each step, the cells that its displacements crack further, and the forces of closed
// crack faces.
#pragma once

#include <optional>
#include <vector>

#include "failure/cell_law.h"
#include "failure/crack_tracks.h"
#include "failure/face_forces.h"
#include "failure/fracturing.h"
#include "failure/row_reach.h"
#include "failure/strain_rows.h"
#include "koshi/model.h"
#include "mechanics/cell_stress.h"

namespace koshi::failure {

/// Keeps State::crack, State::face_force and the factors of the model's cells together. Every rank follows all cells
/// that touch its nodes, so that the bits do not depend on the ranks and no cracks are exchanged.
class Cracking : public Fracturing {
 public:
  /// The model must have a material that can crack, and its cells their factors without cracks; it has those with the
  /// cracks of the state from then on.
  Cracking(model::Model& model, model::State& state);

  void restore() override;
  void follow(double dt) override;
  void note_row(std::int64_t j, std::int64_t k) override { reach_.note(j, k); }
  void look_again() override { reach_.forget(); }
  void add_forces(std::int64_t j, std::int64_t k, double* const* force) const override { carried_.add(j, k, force); }
  void lay_forces() override;

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
  std::optional<Crack> begin(std::int64_t n, const Tensor6& strain) const;
  void crack_further(std::int64_t n, double dt);
  /// They stand behind the other cracked cells then, until these are sorted.
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

  // Cells that have cracked, in motion (cracking_faces.cpp).
  /// What each step asks of a cracked cell, side by side: a cell's values in the fields lie far apart.
  struct Face {
    std::int64_t cell;
    std::uint16_t material;
    bool fresh;      ///< cracked in this step
    double share;    ///< share() of the cell
    double further;  ///< equivalent strain below which it does not crack further
    Vec3 normal, slip;
  };
  Face face_of(std::int64_t n) const;
  void insert_faces(std::size_t known);
  void follow_faces(double dt);
  void restore_faces();
  void slide(Face& face, const Tensor6& strain);
  void carry(const Face& face, const Tensor6& strain);
  void fetch_face(std::size_t at) const;

  Crack load(std::int64_t n) const;
  void store(std::int64_t n, const Crack& crack);
  const CellLaw& law(std::int64_t n) const { return *laws_[model_.lattice.cell.component(0)[n]]; }

  std::vector<std::optional<CellLaw>> laws_;  ///< by material index
  std::vector<Bound> bounds_;                 ///< by material index
  std::vector<double> per_strain_;            ///< by material index: the reach that a lacking strain of 1 gives [m]
  const StrainRows& rows_;
  std::vector<double> mean_, radius_;  ///< of a row
  lattice::Field<float> whole_;        ///< factors of the cells without cracks
  lattice::Field<float> limit_;  ///< equivalent strain below which a cell does not crack; infinite: rows pass by it
  CrackTracks tracks_;
  std::vector<char> breakable_;  ///< rows of cells with a material that can crack
  RowReach reach_;
  std::vector<std::int64_t> cracked_;  ///< cracked cells, ascending
  std::vector<std::int64_t> begun_;    ///< cells whose cracks began in this step or event
  std::vector<Face> faces_;            ///< those of cracked_, in the same order
  FaceForces carried_;                 ///< by closed ones
  bool laid_ = false;                  ///< State::face_force is what they carry
};

}  // namespace koshi::failure
