// Where cracks go on: along the planes of the cells that have cracked (theory, section 12, "Where a crack goes").
#pragma once

#include <span>

#include "failure/cell_law.h"
#include "koshi/model.h"

namespace koshi::failure {

/// Planes of cracked cells, and what they mean for the cells around these: a crack that began by tension goes on in
/// neighbours that its plane cuts, others beside it hold more than their strength. The plane of a new cell takes up
/// those of its neighbours.
class CrackTracks {
 public:
  /// Of State::crack; it and the model must outlive this.
  CrackTracks(const model::Model& model, const model::State& state);

  /// Takes all cracks of the state (ghosts up to date) (collective).
  void restore();
  /// Takes those of these cells, which began since the last call; every rank gives all of them that touch its nodes
  /// (collective).
  void follow(std::span<const std::int64_t> begun);

  /// The equivalent strain at which a crack begins in a cell that touches an owned node, over that of the strength: 1,
  /// or more beside cracks that lead elsewhere.
  double hold(std::int64_t n, const Crack& crack) const;
  /// The unit normal of the cracks that lead here; 0 if none does.
  Vec3 lead(std::int64_t n) const;
  /// How far from the middle of its cell a crack that begins lies, along its normal [m]; infinite if none goes on along
  /// it.
  double offset(std::int64_t n, const Crack& crack) const;

 private:
  // Components of the fields.
  enum Plane { normal = 0, from_middle = 3, plane_parts };
  enum Ahead { others_normal = 0, distance = 3, beside, ahead_parts };

  template <class F>
  void for_each_here(F&& f) const;
  void take(std::int64_t n);
  void look_ahead(std::int64_t n);
  void look_ahead_around(std::int64_t n);

  const model::Model& model_;
  const model::State& state_;
  lattice::Field<float> plane_;  ///< of cells: unit normal, distance over d; the normal is 0 if no crack goes on there
  /// Of cells: unit normal of the plane of the cracks that lead here and its distance over d; or 1 in the last if
  /// cracks are beside the cell and none leads here, and their normal. The normal is 0 if there are no cracks.
  lattice::Field<float> ahead_;
};

}  // namespace koshi::failure
