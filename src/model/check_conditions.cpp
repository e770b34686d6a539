// Checks of boundaries, loads and probes.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "model/check.h"
#include "model/check_selection.h"
#include "model/choices.h"
#include "model/formula.h"
#include "model/selection.h"

namespace koshi::model {
namespace {

// Names head columns and keys of the output: of one line, different. Only probes need one.
template <class D>
void check_names(const Checker& check, const std::string& section, const std::vector<D>& list) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string path = fmt::format("{}[{}].name", section, i);
    const std::string& name = list[i].name;
    if (name.empty() && section != "probe") continue;
    if (name.empty())
      check.fail(path, fmt::format("the name of a {} is empty; give it a name, such as \"top\"", section));
    if (std::any_of(name.begin(), name.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }))
      check.fail(path, fmt::format("the name of a {} holds a control character; names are of one line", section));
    if (!names.insert(name).second)
      check.fail(path, fmt::format("two {} tables are called \"{}\"; names must differ", section, name));
  }
}

// Vibrations are about the body at rest: supports hold or they are none.
void check_support_of_modes(const Checker& check, const std::string& path, const BoundaryDefinition& boundary) {
  const auto refuse = [&](const std::string& key, std::size_t c, const std::optional<double>& value) {
    if (value && *value != 0)
      check.fail(
          fmt::format("{}.{}.{}", path, key, component_names[c]),
          fmt::format("boundary \"{}\" moves its nodes, but modes are vibrations about the body at rest; hold {} "
                      "by fix, or leave it free",
                      boundary.name, component_names[c]));
  };
  for (std::size_t c = 0; c < 6; ++c) {
    refuse("displacement", c, boundary.displacement[c]);
    refuse("velocity", c, boundary.velocity[c]);
  }
  for (std::size_t axis = 0; axis < 3; ++axis) refuse("twist", axis, boundary.twist[axis]);
}

void check_boundary(const Checker& check, const std::string& path, const BoundaryDefinition& boundary) {
  const std::string title = fmt::format("boundary \"{}\"", boundary.name);
  check_selection(check, path, title, boundary.selection);

  // Each component may be prescribed once; a twist about an axis takes the two displacements across it and the
  // rotation about it.
  std::array<std::string, 6> prescribed_by;
  const auto prescribe = [&](std::size_t c, const std::string& key, const std::string& at) {
    const std::string component(component_names[c]);
    if (!prescribed_by[c].empty())
      check.fail(path + "." + at, fmt::format("{} prescribes {} by {} and by {}; keep one of them", title, component,
                                              prescribed_by[c], key));
    prescribed_by[c] = key;
  };
  const auto within = [&](const Range& range, const std::string& at, double value) {
    check.within(range, fmt::format("{}.{}", path, at), value);
  };
  for (std::size_t c = 0; c < 6; ++c) {
    if (boundary.fix[c]) prescribe(c, "fix", "fix");
    if (boundary.displacement[c]) {
      const std::string at = fmt::format("displacement.{}", component_names[c]);
      prescribe(c, "displacement", at);
      within(c < 3 ? ranges::displacement : ranges::rotation, at, *boundary.displacement[c]);
    }
    if (boundary.velocity[c]) {
      const std::string at = fmt::format("velocity.{}", component_names[c]);
      prescribe(c, "velocity", at);
      within(c < 3 ? ranges::velocity : ranges::angular_velocity, at, *boundary.velocity[c]);
    }
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!boundary.twist[axis]) continue;
    const std::string at = fmt::format("twist.{}", component_names[axis]);
    within(ranges::rotation, at, *boundary.twist[axis]);
    for (const std::size_t c : {(axis + 1) % 3, (axis + 2) % 3, axis + 3})
      prescribe(c, fmt::format("twist about {}", component_names[axis]), at);
  }
  const bool moves_or_fixes =
      std::any_of(prescribed_by.begin(), prescribed_by.end(), [](const auto& key) { return !key.empty(); });
  if (!moves_or_fixes && !boundary.support)
    check.fail(path,
               fmt::format("{} prescribes nothing; give it fix, displacement, velocity, twist or support", title));
  if (boundary.support && surfaces_of(boundary.selection, check.definition).empty())
    check.fail(path + ".support",
               fmt::format("{} is a support by a surface, but selects none; give it the surface of a region, or hold "
                           "nodes by fix",
                           title));

  // The fitted rotation of a cell is no unknown: a fixed one is met by fixed displacements, a turned one is not.
  if (check.definition.lattice.kinematics == material::Kinematics::least_squares)
    for (std::size_t c = 3; c < 6; ++c)
      for (const bool velocity : {false, true}) {
        const auto& value = velocity ? boundary.velocity[c] : boundary.displacement[c];
        if (value && *value != 0)
          check.fail(fmt::format("{}.{}.{}", path, velocity ? "velocity" : "displacement", component_names[c]),
                     fmt::format("{} prescribes the rotation {}, but least-squares kinematics has no rotations; take "
                                 "twist, or kinematics \"rotational\"",
                                 title, component_names[c]));
      }

  if (check.definition.analysis.type == AnalysisDefinition::Type::modes) check_support_of_modes(check, path, boundary);
  if (check.definition.analysis.type == AnalysisDefinition::Type::statics)
    for (std::size_t c = 0; c < 6; ++c)
      if (boundary.velocity[c])
        check.fail(
            fmt::format("{}.velocity.{}", path, component_names[c]),
            fmt::format("{} prescribes a velocity, but a static analysis knows no time; give displacement, or the "
                        "type \"quasi-static\" or \"dynamic\"",
                        title));

  check.within(ranges::ramp, path + ".ramp", boundary.ramp);
  if (boundary.center) check.within(ranges::position, path + ".center", *boundary.center);
  check_history(check, path + ".history", boundary.history);
}

void check_profile(const Checker& check, const std::string& path, const std::string& title,
                   const LoadDefinition& load) {
  if (load.profile.empty()) return;
  if (load.force)
    check.fail(path, fmt::format("{} is a total force, which takes no profile; give traction or pressure", title));
  try {
    const Formula formula(load.profile);
    if (formula.varies_in_time() && !check.definition.analysis.stepped())
      check.fail(path, fmt::format("{} has a profile that depends on t, but only motion knows the time; leave t out, "
                                   "or give the type \"quasi-static\" or \"dynamic\"",
                                   title));
  } catch (const InputError& error) {
    check.fail(path, error.message());
  }
}

void check_load(const Checker& check, const std::string& path, const LoadDefinition& load) {
  const std::string title = fmt::format("load \"{}\"", load.name);
  std::vector<std::string> given;
  const auto add = [&](const Range& range, const std::string& key, const auto& value) {
    if (!value) return;
    given.push_back(key);
    check.within(range, path + "." + key, *value);
  };
  add(ranges::force, "force", load.force);
  add(ranges::pressure, "traction", load.traction);
  add(ranges::pressure, "pressure", load.pressure);
  add(ranges::acceleration, "acceleration", load.acceleration);
  if (given.empty())
    check.fail(path, fmt::format("{} loads nothing; give it one of force, traction, pressure, acceleration", title));
  if (given.size() > 1)
    check.fail(path + "." + given[1],
               fmt::format("{} has both {}; give one of force, traction, pressure, acceleration (one load each)", title,
                           fmt::join(given, " and ")));

  const Selection& selection = load.selection;
  if (load.acceleration) {
    if (const auto keys = given_keys(selection); !keys.empty())
      check.fail(path + "." + keys[0],
                 fmt::format("{} is an acceleration of the whole body; leave {} out", title, keys[0]));
  } else {
    check_selection(check, path, title, selection);
  }
  if (selection.point && (load.traction || load.pressure))
    check.fail(path + ".point",
               fmt::format("{} is a {} on a point, which has no area; select a face or box, or give force", title,
                           load.traction ? "traction" : "pressure"));
  check_profile(check, path + ".profile", title, load);
  check_history(check, path + ".history", load.history);
}

void check_probe(const Checker& check, const std::string& path, const ProbeDefinition& probe) {
  const std::string title = fmt::format("probe \"{}\"", probe.name);
  check_selection(check, path, title, probe.selection);
  if (probe.quantity == ProbeDefinition::Quantity::moment && probe.reduction() != ProbeDefinition::Reduce::sum)
    check.fail(path + ".reduce", fmt::format("{} is a moment, which is a sum over its nodes; leave reduce out", title));
  check.within(ranges::percentile, path + ".percentile", probe.percentile);
  if (probe.center) check.within(ranges::position, path + ".center", *probe.center);
  if (probe.minus.empty()) return;
  using D = ProbeDefinition;
  check_named_selection(check, path + ".minus", probe.minus);
  if (probe.quantity != D::Quantity::displacement && probe.quantity != D::Quantity::rotation &&
      probe.quantity != D::Quantity::velocity)
    check.fail(path + ".minus", fmt::format("{} takes the mean of a selection off, which has a meaning for "
                                            "displacement, rotation and velocity; leave minus out",
                                            title));
  if (probe.reduction() != D::Reduce::mean && probe.reduction() != D::Reduce::area_mean)
    check.fail(path + ".minus", fmt::format("{} takes a mean off; reduce is to be \"mean\" or \"area-mean\"", title));
}

}  // namespace

void check_history(const Checker& check, const std::string& path, const History& history) {
  for (std::size_t i = 0; i < history.size(); ++i) {
    const std::string pair = fmt::format("{}[{}]", path, i);
    check.within(ranges::moment_of_history, pair + "[0]", history[i][0]);
    check.within(ranges::factor, pair + "[1]", history[i][1]);
    if (i > 0 && !(history[i][0] > history[i - 1][0]))
      check.fail(pair, fmt::format("time {:.12g} s does not come after {:.12g} s; the times of a history must rise",
                                   history[i][0], history[i - 1][0]));
  }
}

void check_conditions(const Checker& check) {
  const Definition& definition = check.definition;
  check_selections(check);
  check_names(check, "boundary", definition.boundaries);
  check_names(check, "load", definition.loads);
  check_names(check, "probe", definition.probes);
  for (std::size_t i = 0; i < definition.boundaries.size(); ++i)
    check_boundary(check, fmt::format("boundary[{}]", i), definition.boundaries[i]);
  for (std::size_t i = 0; i < definition.loads.size(); ++i)
    check_load(check, fmt::format("load[{}]", i), definition.loads[i]);
  for (std::size_t i = 0; i < definition.probes.size(); ++i)
    check_probe(check, fmt::format("probe[{}]", i), definition.probes[i]);
}

}  // namespace koshi::model
