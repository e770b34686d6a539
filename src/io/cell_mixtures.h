// Cells of a coarsened image that hold two solids.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "koshi/definition.h"

namespace koshi::io {

/// Makes materials for such cells: one for each pair of solids and each share in sixteenths that occurs. Solids that
/// crack or scatter are not mixed, and none where the materials of cells tell grains apart: the solid with most voxels
/// counts alone there.
class CellMixtures {
 public:
  explicit CellMixtures(const model::Definition& definition) : definition_(definition) {}

  /// Index of the material of a cell with `count` voxels of each solid, at least one; of more than two solids the two
  /// with most voxels count.
  std::uint16_t material_of(const std::map<std::uint16_t, int>& count);
  /// Density of that material [kg/m^3].
  double density(std::uint16_t material) const;

  /// Materials of the mixtures, to be put behind those of the definition, once every cell has its material: `material`,
  /// x fastest. Of a pair the solid that leads through the body along fewer axes is the inclusion; where both lead
  /// through as many, the inclusion is made up of both, mostly of the one with fewer voxels.
  std::vector<model::MaterialDefinition> materials(const std::vector<std::uint16_t>& material, const Int3& cells) const;
  const std::vector<model::Mixture>& mixtures() const { return mixtures_; }

 private:
  bool mixes(std::uint16_t material) const;
  const model::MaterialDefinition& solid(std::uint16_t material) const { return definition_.materials[material - 1u]; }

  const model::Definition& definition_;
  std::vector<model::Mixture> mixtures_;
  std::map<std::pair<std::array<std::uint16_t, 2>, int>, std::uint16_t> known_;  ///< by pair and sixteenths
  std::map<std::uint16_t, std::int64_t> voxels_;                                 ///< of each solid
};

}  // namespace koshi::io
