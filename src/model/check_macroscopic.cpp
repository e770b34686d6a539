// Checks of the mean strain and stress of a periodic body.
#include <fmt/format.h>

#include <algorithm>

#include "model/check.h"
#include "model/choices.h"

namespace koshi::model {
namespace {

constexpr std::array<const char*, 6> names{"xx", "yy", "zz", "yz", "xz", "xy"};

// A component needs periods along both of its axes: without, nothing in the body feels it.
void check_component(const Checker& check, const std::string& path, std::size_t c) {
  for (const std::size_t a : tensor_axes[c])
    if (!check.definition.body.periodic[a])
      check.fail(path, fmt::format("a macroscopic {} needs a body that is periodic along its axes, and this one is not "
                                   "in {}; add \"{}\" to body.periodic, or leave {} out",
                                   names[c], "xyz"[a], "xyz"[a], names[c]));
}

// Displacements along a period grow from image to image: no node can be held there.
void check_boundary(const Checker& check, const std::string& path, const BoundaryDefinition& boundary) {
  for (std::size_t a = 0; a < 3; ++a) {
    if (!check.definition.body.periodic[a]) continue;
    bool prescribed = boundary.fix[a] || boundary.displacement[a] || boundary.velocity[a];
    for (const std::size_t axis : {(a + 1) % 3, (a + 2) % 3}) prescribed = prescribed || boundary.twist[axis];
    if (prescribed)
      check.fail(path, fmt::format("boundary \"{}\" prescribes {}, along which the body is periodic and has a "
                                   "macroscopic strain; leave {} out: what moves the body as a whole is taken out",
                                   boundary.name, "xyz"[a], "xyz"[a]));
  }
}

void check_analysis(const Checker& check) {
  const Definition& definition = check.definition;
  const auto type = definition.analysis.type;
  if (type == AnalysisDefinition::Type::modes)
    check.fail("macroscopic",
               "modes swing about the body as it is, so that a macroscopic strain changes nothing; leave [macroscopic] "
               "out, or use another analysis.type than \"modes\"");
  // A strain that moved until it met the stress would need an inertia, which the body does not have as a whole.
  if (definition.analysis.stepped() && definition.macroscopic->stress)
    check.fail("macroscopic.stress",
               fmt::format("mean stresses are met in equilibrium alone; use analysis.type = \"static\" instead of "
                           "\"{}\", or give the mean strain",
                           choice_name(type)));
  if (definition.cracks())
    check.fail("macroscopic",
               "cracks are not followed under a macroscopic strain; set law = \"none\" in the fracture of the "
               "materials, or leave [macroscopic] out");
  if (definition.lattice.springs == material::Sharing::plain)
    check.fail("macroscopic",
               "plain springs belong to no cell, so that their stress has no mean; set lattice.springs = \"shared\"");
}

}  // namespace

void check_macroscopic(const Checker& check) {
  const Definition& definition = check.definition;
  if (!definition.macroscopic) return;
  const MacroscopicDefinition& macroscopic = *definition.macroscopic;
  if (definition.body.periodic == std::array<bool, 3>{})
    check.fail("macroscopic",
               "macroscopic strain without periodic directions: it is the strain of a body that is repeated; set "
               "body.periodic, such as periodic = [\"x\", \"y\", \"z\"], or strain the body by a [[boundary]]");
  std::size_t given = 0;
  for (std::size_t c = 0; c < 6; ++c) {
    const auto strain = macroscopic.strain_of(c);
    const auto stress = macroscopic.stress_of(c);
    const std::string of_strain = fmt::format("macroscopic.strain.{}", names[c]);
    const std::string of_stress = fmt::format("macroscopic.stress.{}", names[c]);
    if (strain && stress)
      check.fail(of_stress,
                 fmt::format("{} has both a mean strain and a mean stress; one follows from the other: leave "
                             "one of them out",
                             names[c]));
    if (strain || stress) check_component(check, strain ? of_strain : of_stress, c);
    if (strain) check.within(ranges::mean_strain, of_strain, *strain);
    if (stress) check.within(ranges::pressure, of_stress, *stress);
    given += strain || stress;
  }
  if (given == 0)
    check.fail("macroscopic",
               "[macroscopic] gives no component; give some, such as strain = { xx = 0.001 } or stress = { xx = \"1 "
               "MPa\" }");
  check_history(check, "macroscopic.history", macroscopic.history);
  for (std::size_t b = 0; b < definition.boundaries.size(); ++b)
    check_boundary(check, fmt::format("boundary[{}]", b), definition.boundaries[b]);
  check_analysis(check);
}

}  // namespace koshi::model
