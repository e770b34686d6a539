// Stress and strain at surfaces and in cells that surfaces cut, extrapolated from the whole cells there.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "koshi/field.h"
#include "mechanics/cell_stress.h"

namespace koshi::mechanics {

/// Linear extrapolation to places in some cells. A whole cell gives the linear field fitted to the whole cells of its
/// material around it and itself; another takes the mean of what those around it give, near ones more; without any, its
/// own values.
class SurfaceStress {
 public:
  struct Value {
    Tensor6 strain{}, stress{};  // stress in Pa
  };

  /// For places in these cells, solid ones that this rank owns (collective).
  SurfaceStress(const model::SpringLattice& body, std::span<const std::int64_t> cells);

  /// Takes the displacements, ghosts up to date (collective).
  void update(const lattice::Field<double>& u);

  /// At a place from the cell's centre, in spacings.
  Value at(std::int64_t cell, const Vec3& from_centre) const;

  /// From the centre of a cell that a surface cuts to the middle of the part inside, in spacings.
  Vec3 middle_of_part(std::int64_t cell) const;

 private:
  static constexpr std::size_t components = 12;
  using Numbers = std::array<double, components>;
  struct Known {
    Numbers value{};
    std::array<Numbers, 3> slope{};  // per spacing along each axis
  };

  struct Near {
    std::int64_t cell = 0;
    int distance = 0;  // to the next of the cells
    bool owned = false;
  };

  bool whole(std::int64_t cell) const { return whole_.component(0)[cell] != 0; }
  /// The linear field of the whole cells around one, at its centre.
  Known fit(std::int64_t cell) const;
  bool alike(std::int64_t a, std::int64_t b) const;
  std::int64_t offset(int neighbour) const;
  /// Fetches a number of near cells from the ranks that own them.
  template <class Member>
  void exchange(Member&& number_of);

  const model::SpringLattice& body_;
  std::vector<std::int64_t> cells_;
  // With all ghosts, which the body has not: material of whole cells, else 0.
  lattice::Field<std::uint16_t> whole_;
  std::vector<Near> near_;                           // whole cells of this rank and its ghosts, up to two cells away
  std::unordered_map<std::int64_t, Known> known_;    // by cell of near_
  std::unordered_map<std::int64_t, Numbers> alone_;  // cells without a whole one around
};

}  // namespace koshi::mechanics
