#include "koshi/definition.h"

#include <algorithm>
#include <tuple>

namespace koshi::model {

Place Places::find(std::string path) const {
  for (;;) {
    if (const auto found = places_.find(path); found != places_.end()) return found->second;
    const auto end = path.find_last_of(".[");
    if (end == std::string::npos) break;
    path.resize(end);
  }
  const auto root = places_.find("");
  return root == places_.end() ? Place{} : root->second;
}

material::Calibration Definition::calibration() const {
  using material::Calibration;
  if (lattice.calibration) return *lattice.calibration;
  if (lattice.springs == material::Sharing::plain) return Calibration::paper;
  return lattice.cell == lattice::CellType::cube_iii ? Calibration::bending_exact : Calibration::isotropic;
}

bool Definition::cracks() const {
  return std::any_of(materials.begin(), materials.end(), [](const MaterialDefinition& m) { return m.cracks(); });
}

bool Definition::breaks_bonds() const {
  return std::any_of(materials.begin(), materials.end(), [](const MaterialDefinition& m) {
    return m.fracture && m.fracture->law == material::FractureLaw::bonds;
  });
}

bool Definition::varies_in_stiffness() const {
  return std::any_of(materials.begin(), materials.end(),
                     [](const MaterialDefinition& m) { return m.stiffness_scatter.has_value(); });
}

bool Definition::varies_in_strength() const {
  const bool scattered = std::any_of(materials.begin(), materials.end(), [](const MaterialDefinition& m) {
    return m.cracks() && m.fracture->strength_scatter.has_value();
  });
  const bool weak_boundaries = body.grain_boundary && body.grain_boundary->strength;
  return cracks() && (scattered || weak_boundaries || !body.strengths.empty());
}

bool Definition::operator==(const Definition& other) const {
  const auto input = [](const Definition& d) {
    return std::tie(d.title, d.lattice, d.body, d.materials, d.regions, d.pre_cracks, d.selections, d.boundaries,
                    d.loads, d.macroscopic, d.analysis, d.probes, d.output);
  };
  return input(*this) == input(other);
}

}  // namespace koshi::model
