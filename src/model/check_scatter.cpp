// Checks of what differs from cell to cell.
#include <fmt/format.h>

#include <algorithm>

#include "model/check.h"

namespace koshi::model {

namespace {

void check_scatter(const Checker& check, const std::string& path, const material::Scatter& scatter) {
  if (scatter.distribution == material::Distribution::weibull)
    check.within(ranges::weibull_modulus, path + ".modulus", scatter.modulus);
  else
    check.within(ranges::variation, path + ".variation", scatter.variation);
  check.within(ranges::correlation_length, path + ".correlation_length", scatter.correlation_length);
  check.within(ranges::seed, path + ".seed", scatter.seed);
  // The noise of a cell reaches two lengths far, and every rank makes that of all cells within reach of its own.
  constexpr double most = 100;
  const double d = check.definition.lattice.spacing;
  // The spacing of an image is 0 until it is read; then this check comes again.
  if (d > 0 && scatter.correlation_length > most * d)
    check.fail(
        path + ".correlation_length",
        fmt::format("a correlation length of {:.6g} m is more than {:.0f} cells of {:.6g} m; take at most {:.6g} "
                    "m, or give slower changes by regions or body.strength",
                    scatter.correlation_length, most, d, most * d));
}

void check_grain_boundary(const Checker& check, const GrainBoundaryDefinition& boundary) {
  const std::string path = "body.grain_boundary";
  if (boundary.material.empty() == !boundary.strength)
    check.fail(path, "grain_boundary takes exactly one of material and strength");
  if (!boundary.labels.empty()) check_cell_file(check, path + ".labels", "the file", boundary.labels);
  if (!boundary.material.empty()) check_material_name(check, path + ".material", boundary.material);
  check.within(ranges::strength_share, path + ".strength", boundary.strength);
}

}  // namespace

void check_scatter(const Checker& check) {
  const Definition& definition = check.definition;
  for (const MaterialDefinition& material : definition.materials) {
    const std::string path = "material." + material.name;
    if (material.stiffness_scatter) {
      check_scatter(check, path + ".stiffness_scatter", *material.stiffness_scatter);
      if (definition.lattice.springs == material::Sharing::plain)
        check.fail(path + ".stiffness_scatter",
                   "cells have no springs of their own to multiply with lattice.springs = \"plain\"; take \"shared\"");
    }
    if (material.fracture && material.fracture->strength_scatter)
      check_scatter(check, path + ".fracture.strength_scatter", *material.fracture->strength_scatter);
  }
  if (definition.body.grain_boundary) check_grain_boundary(check, *definition.body.grain_boundary);

  // Strengths of cells mean nothing where nothing cracks.
  const bool strengths = !definition.body.strength.empty() || !definition.body.strengths.empty();
  if (!definition.body.strength.empty()) check_cell_file(check, "body.strength", "the file", definition.body.strength);
  const bool has_fracture =
      std::any_of(definition.materials.begin(), definition.materials.end(), [](const auto& m) { return m.fracture; });
  const auto need_fracture = [&](const std::string& path) {
    if (!has_fracture)
      check.fail(path,
                 "no material has a strength for this to multiply; give one a fracture, such as fracture = { "
                 "tensile_strength = \"3 MPa\", fracture_energy = \"100 J/m^2\" }");
  };
  if (strengths) need_fracture("body.strength");
  if (definition.body.grain_boundary && definition.body.grain_boundary->strength)
    need_fracture("body.grain_boundary.strength");
}

}  // namespace koshi::model
