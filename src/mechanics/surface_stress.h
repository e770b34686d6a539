// Stress and strain at surfaces and in cells that surfaces cut, recovered from the cells there.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "koshi/field.h"
#include "mechanics/cell_stress.h"

namespace koshi::mechanics {

/// Values at places in some cells. A whole cell gives the quadratic field (linear in a body without cut cells) fitted
/// to the cells of its material around it and itself, those that a surface cuts by their part inside; another takes the
/// mean of what the whole ones around it give, near ones more; without any, its own values.
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
  // 1, x, y, z, x^2, y^2, z^2, yz, xz, xy, in spacings from a cell's centre.
  static constexpr std::size_t powers = 10;
  struct Known {
    Numbers value{};                      // means over the cell, or its part
    std::array<double, powers> mean{};    // of the powers over it
    std::array<Numbers, powers> field{};  // factors of the powers; whole cells only
  };

  struct Near {
    std::int64_t cell = 0;
    int distance = 0;  // to the next of the cells
    bool owned = false;
  };

  bool whole(std::int64_t cell) const { return part_.component(0)[cell] == 1; }
  /// The field of the cells around a whole one.
  std::array<Numbers, powers> fit(std::int64_t cell) const;
  /// Means of the powers over the part of a cell inside.
  std::array<double, powers> means(std::int64_t cell) const;
  /// Whether two cells have the same material.
  bool alike(std::int64_t a, std::int64_t b) const { return material_.component(0)[a] == material_.component(0)[b]; }
  std::int64_t offset(int neighbour) const;
  /// Fetches a number of near cells from the ranks that own them.
  template <class Member>
  void exchange(Member&& number_of);

  const model::SpringLattice& body_;
  std::vector<std::int64_t> cells_;
  // With all ghosts, which the body has not: material, and part inside, of solid cells.
  lattice::Field<std::uint16_t> material_;
  lattice::Field<float> part_;
  std::vector<Near> near_;                           // solid cells of this rank and its ghosts, up to two cells away
  std::unordered_map<std::int64_t, Known> known_;    // by cell of near_
  std::unordered_map<std::int64_t, Numbers> alone_;  // cells without a whole one around
};

}  // namespace koshi::mechanics
