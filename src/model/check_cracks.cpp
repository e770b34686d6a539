// Checks of cracks that a body has from the start, and of what ends a run.
#include <fmt/format.h>

#include <algorithm>

#include "base/suggest.h"
#include "model/check.h"

namespace koshi::model {

namespace {

void check_crack(const Checker& check, const std::string& path, const CrackDefinition& crack) {
  if (!check.definition.cracks())
    check.fail(path,
               "cracks belong to materials that crack, and there is none; give one a fracture, such as fracture = "
               "{ tensile_strength = \"3 MPa\", fracture_energy = \"100 J/m^2\" }");
  check.within(ranges::position, path + ".center", crack.center);
  check.within(ranges::direction, path + ".normal", crack.normal);
  if (crack.normal == Vec3{}) check.fail(path + ".normal", "normal is zero; it needs a direction such as [1, 0, 0]");
  if (crack.shape == CrackDefinition::Shape::disc) {
    check.within(ranges::size, path + ".radius", crack.radius);
    return;
  }
  check.within(ranges::direction, path + ".along", crack.along);
  check.within(ranges::size, path + ".length", crack.length);
  check.within(ranges::size, path + ".width", crack.width);
  // A direction across the plane leaves none along it.
  if (norm(cross(crack.along, crack.normal)) < 1e-6 * norm(crack.along) * norm(crack.normal))
    check.fail(path + ".along", "along is zero or points across the plane; it needs a direction in the plane");
}

void check_stop(const Checker& check, const StopDefinition& stop) {
  const std::string path = "analysis.stop_when";
  const Definition& definition = check.definition;
  if (stop.probe.empty() && !stop.face)
    check.fail(path,
               "stop_when has no condition; give a probe with below, such as { probe = \"pull\", below = 0.2 }, or "
               "a face such as { face = \"x-max\" }");
  const bool at_rest = definition.analysis.type == AnalysisDefinition::Type::statics;
  if (at_rest && !definition.cracks())
    check.fail(
        path,
        "no material can crack, and such an equilibrium is found at once, with nothing to stop on the way; give a "
        "material a fracture, or leave stop_when out");
  check.within(ranges::moment, path + ".after", stop.after);
  if (at_rest && stop.after != 0 && !definition.analysis.steps)
    check.fail(path + ".after", "a static analysis without steps has no time that could pass before; leave after out");
  if (stop.face && !definition.cracks())
    check.fail(path + ".face", "no material can crack, so that no crack reaches a face; give one a fracture");
  if (stop.probe.empty()) return;
  check.within(ranges::part_of_peak, path + ".below", stop.below);
  std::vector<std::string> names;
  for (const ProbeDefinition& probe : definition.probes)
    if (probe.quantity == ProbeDefinition::Quantity::reaction) names.push_back(probe.name);
  if (std::find(names.begin(), names.end(), stop.probe) == names.end())
    check.fail(path + ".probe", fmt::format("there is no probe \"{}\" of a reaction; {}", stop.probe,
                                            names.empty() ? "add a [[probe]] with quantity = \"reaction\""
                                                          : suggestion(stop.probe, names)));
}

}  // namespace

void check_cracks(const Checker& check) {
  for (std::size_t c = 0; c < check.definition.pre_cracks.size(); ++c)
    check_crack(check, fmt::format("crack[{}]", c), check.definition.pre_cracks[c]);
  if (check.definition.analysis.stop_when) check_stop(check, *check.definition.analysis.stop_when);
  if (check.definition.output.crack_surface && !check.definition.cracks())
    check.fail("output.crack_surface",
               "a surface of cracks needs a material that cracks, and there is none; give one a fracture, or leave it "
               "out");
}

}  // namespace koshi::model
