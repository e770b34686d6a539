// Cells that surfaces cut: which part of each material a cell holds.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "koshi/definition.h"
#include "koshi/grid.h"
#include "koshi/spring_lattice.h"
#include "model/shapes.h"

namespace koshi::model {

/// A cell as the lattice takes it.
struct CellPart {
  std::uint16_t material = 0;  ///< the one that fills most of what is solid; 0: empty
  double fraction = 0;         ///< of the volume that is solid; 0 for an empty cell
  double left_out = 0;         ///< of a cell that is empty because less than `least` of it is solid
  static constexpr double least = 0.002;
};

/// The body of a definition as layers of regions over its material or image, where the last region that holds a point
/// gives it its material. The definition must have passed check() and outlive the object.
class CutBody {
 public:
  CutBody(const Definition& definition, const lattice::Grid& grid);

  /// Parts of a global cell, the same on every rank.
  CellPart part_of(const Int3& cell) const;

  /// Moments of what is solid in a global cell, of any material.
  Moments moments_of(const Int3& cell) const;

  /// Material at a point of a global cell, with region `forced` taken as holding the point or not (-1: none); border
  /// points belong to regions.
  std::uint16_t material_at(const Vec3& x, const Int3& cell, int forced = -1, bool holds = false) const;

 private:
  struct Layer {
    std::uint16_t material = 0;
    std::vector<Primitive> primitives;
    const RegionDefinition* region = nullptr;
  };
  struct Cube {
    Vec3 centre{};
    double edge = 0;
  };
  /// The surfaces that pass through a cell: of each layer that does not miss it.
  struct Passing {
    std::uint16_t material = 0;
    std::vector<Primitive> surfaces;  ///< none: the layer holds the whole cube
  };

  std::vector<Passing> passing(const Cube& cube, const Int3& cell) const;
  static std::vector<Passing> narrowed(const std::vector<Passing>& layers, const Cube& cube);
  /// Halves a cube of a cell until no surface or a nearly flat one passes, as `flat(surface, edge)` says, and calls
  /// whole(material, cube) or cut(surface, material inside, material outside, cube).
  template <class Flat, class Whole, class Cut>
  static void divide(const Cube& cube, int depth, const std::vector<Passing>& layers, std::uint16_t background,
                     const Flat& flat, const Whole& whole, const Cut& cut);
  std::size_t index(const Int3& cell) const;
  std::uint16_t background(const Int3& cell) const;
  const CutCell* cut_cell(const RegionDefinition& region, const Int3& cell) const;
  bool inside(const RegionDefinition& region, const Int3& cell) const;
  Primitive plane_of(const CutCell& cut, const Int3& cell) const;

  const Definition& definition_;
  lattice::Grid grid_;
  std::uint16_t material_ = 0;
  std::vector<Layer> layers_;  ///< by region
};

}  // namespace koshi::model
