#include "driver/warnings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "failure/softening.h"
#include "koshi/error.h"
#include "mechanics/self_check.h"
#include "model/choices.h"

namespace koshi::driver {
namespace {

using model::BoundaryDefinition;
using model::Definition;

void check_springs(const model::Model& model, std::vector<std::string>& warnings) {
  const Definition& definition = model.definition;
  const model::LatticeDefinition& lattice = definition.lattice;
  // Only Poisson's ratio matters: E and density scale all motions alike.
  std::set<double> seen;
  for (std::size_t m = 1; m < model.lattice.springs.size(); ++m) {
    const material::Elastic& elastic = model.materials[m];
    if (!seen.insert(elastic.poissons_ratio).second) continue;
    const mechanics::SelfCheck check =
        mechanics::self_check(model.lattice.springs[m], lattice.spacing, lattice.kinematics, lattice.springs, elastic);
    if (check.verdict == mechanics::Verdict::ok) continue;
    const std::string text =
        fmt::format("the springs of material \"{}\" (nu = {:g}): {}; {}", definition.materials[m - 1].name,
                    elastic.poissons_ratio, check.reason, check.remedy);
    if (check.verdict == mechanics::Verdict::refuse)
      throw InputError(definition.places.find("lattice.calibration"), text);
    if (definition.analysis.type == model::AnalysisDefinition::Type::modes)
      throw InputError(definition.places.find("lattice.calibration"),
                       text + "; loose rotations would swing at frequencies that mean nothing");
    // Motion does not excite loose rotations; equilibrium has to determine them.
    if (definition.analysis.type == model::AnalysisDefinition::Type::statics) warnings.push_back(text);
  }
}

// What a search for modes has no use for.
void check_unused(const Definition& definition, std::vector<std::string>& warnings) {
  if (definition.analysis.type != model::AnalysisDefinition::Type::modes) return;
  if (!definition.loads.empty()) warnings.push_back("loads do not count: modes are vibrations about the unloaded body");
  if (!definition.probes.empty()) warnings.push_back("probes do not count: the shapes of modes are in fields");
}

/// Components a boundary prescribes.
std::array<bool, 6> prescribed(const BoundaryDefinition& boundary) {
  std::array<bool, 6> components = boundary.fix;
  for (std::size_t c = 0; c < 6; ++c)
    if (boundary.displacement[c] || boundary.velocity[c]) components[c] = true;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (boundary.twist[axis])
      for (const std::size_t c : {(axis + 1) % 3, (axis + 2) % 3, axis + 3}) components[c] = true;
  return components;
}

void check_platens(const Definition& definition, std::vector<std::string>& warnings) {
  // Plain springs are the paper's, whose surfaces are not exact in any case; edges alone carry no such moment.
  const model::LatticeDefinition& lattice = definition.lattice;
  if (lattice.kinematics != material::Kinematics::rotational || lattice.springs != material::Sharing::shared ||
      lattice.cell == lattice::CellType::cube_i)
    return;
  for (const auto& [face_name, face] : model::choices<model::Face>) {
    const std::size_t across = static_cast<std::size_t>(face) / 2;
    const std::array<std::size_t, 2> along{(across + 1) % 3, (across + 2) % 3};
    // A platen without edges turns nowhere.
    if (definition.body.periodic[along[0]] && definition.body.periodic[along[1]]) continue;
    std::array<bool, 6> held{};
    const BoundaryDefinition* platen = nullptr;
    for (const BoundaryDefinition& boundary : definition.boundaries) {
      if (boundary.selection.face != face) continue;
      const std::array<bool, 6> components = prescribed(boundary);
      if (components[across] && platen == nullptr) platen = &boundary;
      for (std::size_t c = 0; c < 6; ++c) held[c] = held[c] || components[c];
    }
    const bool slides = !held[along[0]] && !held[along[1]];
    if (platen == nullptr || !slides || (held[3 + along[0]] && held[3 + along[1]])) continue;
    std::array<std::string_view, 2> missing{model::component_names[3 + along[0]], model::component_names[3 + along[1]]};
    std::sort(missing.begin(), missing.end());
    warnings.push_back(fmt::format(
        "boundary \"{}\" holds {} of face \"{}\" and lets it slide, but leaves its nodes free to turn: along the edges "
        "they will, and the body comes out too soft (a cube of 4 cells a side by 11 %, of 8 by 3 %); a smooth platen "
        "and a plane of symmetry turn no node: add \"{}\", \"{}\" to fix",
        platen->name, model::component_names[across], face_name, missing[0], missing[1]));
  }
}

// A load along a component that its nodes are held in goes into the support, and the body feels nothing of it.
void check_held_loads(const model::Model& model, std::vector<std::string>& warnings) {
  const auto holder = [&](std::int64_t node, int component) {
    const auto at = std::partition_point(model.motions.begin(), model.motions.end(), [&](const auto& motion) {
      return std::pair(motion.node, int{motion.component}) < std::pair(node, component);
    });
    const bool found = at != model.motions.end() && at->node == node && at->component == component;
    return found ? at->boundary : -1;
  };
  for (std::size_t l = 0; l < model.loads.size(); ++l)
    for (int c = 0; c < 3; ++c) {
      std::int64_t free = 0;
      int boundary = -1;
      for (const auto& [node, force] : model.loads[l].forces) {
        if (force[static_cast<std::size_t>(c)] == 0) continue;
        const int by = holder(node, c);
        free += by < 0;
        boundary = std::max(boundary, by);
      }
      boundary = static_cast<int>(model.communicator.max(static_cast<double>(boundary)));
      if (model.communicator.sum(free) > 0 || boundary < 0) continue;
      warnings.push_back(fmt::format(
          "load \"{}\" acts along {} on nodes that boundary \"{}\" holds or moves along {}: its force there goes into "
          "the "
          "support and does nothing to the body; load other nodes, or leave {} out of the boundary",
          model.definition.loads[l].name, model::component_names[static_cast<std::size_t>(c)],
          model.definition.boundaries[static_cast<std::size_t>(boundary)].name,
          model::component_names[static_cast<std::size_t>(c)], model::component_names[static_cast<std::size_t>(c)]));
    }
}

// Cells so large that their elastic energy at the strength is more than a crack takes break at less, or take more
// (theory, 12).
void check_spacing(const Definition& definition, std::vector<std::string>& warnings) {
  const double d = definition.lattice.spacing;
  const double widest = failure::band_width(d, {1 / std::sqrt(3.0), 1 / std::sqrt(3.0), 1 / std::sqrt(3.0)});
  for (const model::MaterialDefinition& material : definition.materials) {
    if (!material.cracks() || material.fracture->law == material::FractureLaw::bonds) continue;
    const double E = material.elastic.youngs_modulus, f_t = material.fracture->tensile_strength;
    const double G_f = material.fracture->fracture_energy, limit = failure::width_limit(E, f_t, G_f);
    // Equal tension along two axes stores this times the energy of tension along one.
    const double biaxial = 2 * (1 - material.elastic.poissons_ratio);
    if (widest * biaxial < limit) continue;
    const double fine = limit * d / widest, finer = fine / biaxial;
    if (widest < limit)
      warnings.push_back(fmt::format(
          "the spacing of {:.4g} m is too coarse for material \"{}\" where tension acts along two axes alike: there a "
          "cell stores {:.3g} times as much energy at its strength as under tension along one, more than a crack "
          "takes. Cracks there open at {:.4g} Pa, but take up to {:.4g} J/m^2, not {:.4g} J/m^2; a spacing below "
          "{:.3g} m keeps both",
          d, material.name, biaxial, f_t, biaxial * G_f * widest / limit, G_f, finer));
    else
      warnings.push_back(fmt::format(
          "the spacing of {:.4g} m is too coarse for material \"{}\": at its tensile strength a cell stores more "
          "energy than a crack takes. It keeps its fracture energy of {:.4g} J/m^2, but cracks across an axis open at "
          "{:.3g} Pa, oblique ones at as little as {:.3g} Pa, not at {:.4g} Pa; a spacing below {:.3g} m keeps both, "
          "one below {:.3g} m also where tension acts along two axes alike",
          d, material.name, G_f, E * failure::threshold(E, f_t, G_f, d), E * failure::threshold(E, f_t, G_f, widest),
          f_t, fine, finer));
  }
}

// An equilibrium knows no way along which faces could have slid.
void check_friction_in_equilibrium(const Definition& definition, std::vector<std::string>& warnings) {
  if (!definition.cracks_in_equilibrium()) return;
  for (const model::MaterialDefinition& material : definition.materials)
    if (material.cracks() && material.fracture->residual_friction_angle != 0)
      warnings.push_back(fmt::format(
          "material \"{}\" has a residual friction, which does not count in equilibrium: closed cracks carry pressure "
          "there and slide freely; follow them in motion, or leave residual_friction_angle out",
          material.name));
}

}  // namespace

std::vector<std::string> warnings(const model::Model& model) {
  std::vector<std::string> warnings;
  check_springs(model, warnings);
  check_platens(model.definition, warnings);
  check_held_loads(model, warnings);
  check_unused(model.definition, warnings);
  check_spacing(model.definition, warnings);
  check_friction_in_equilibrium(model.definition, warnings);
  return warnings;
}

}  // namespace koshi::driver
