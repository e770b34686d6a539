#include "model/check_selection.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/suggest.h"

namespace koshi::model {
namespace {

// A name of the list at the key; without one the message tells what there is.
void check_reference(const Checker& check, const std::string& path, const std::string& kind, const std::string& name,
                     const std::vector<std::string>& names) {
  if (std::find(names.begin(), names.end(), name) != names.end()) return;
  if (names.empty()) check.fail(path, fmt::format("there is no {} \"{}\", nor any other with a name", kind, name));
  check.fail(path, fmt::format("there is no {} \"{}\"; {}", kind, name, suggestion(name, names)));
}

// Names of the first `known`.
std::vector<std::string> names_of_selections(const Definition& definition, std::size_t known) {
  std::vector<std::string> names;
  for (std::size_t s = 0; s < known; ++s) names.push_back(definition.selections[s].name);
  return names;
}

void check_shapes(const Checker& check, const std::string& path, const Selection& s) {
  if (s.box) {
    check.within(ranges::position, path + ".box.min", s.box->first);
    check.within(ranges::position, path + ".box.max", s.box->second);
    check.ordered(path + ".box", s.box->first, s.box->second);
  }
  if (s.point) check.within(ranges::position, path + ".point", *s.point);
  if (s.sphere) {
    check.within(ranges::position, path + ".sphere.center", s.sphere->center);
    check.within(ranges::size, path + ".sphere.radius", s.sphere->radius);
  }
  if (s.cylinder) {
    check.within(ranges::position, path + ".cylinder.start", s.cylinder->start);
    check.within(ranges::position, path + ".cylinder.end", s.cylinder->end);
    check.within(ranges::size, path + ".cylinder.radius", s.cylinder->radius);
    if (s.cylinder->start == s.cylinder->end)
      check.fail(path + ".cylinder.end", "start and end of the cylinder are the same point; its axis needs a length");
  }
  if (s.half_space) {
    check.within(ranges::position, path + ".half_space.point", s.half_space->point);
    check.within(ranges::direction, path + ".half_space.normal", s.half_space->normal);
    if (s.half_space->normal == Vec3{})
      check.fail(path + ".half_space.normal", "normal is zero; it needs a direction such as [0, 0, 1]");
  }
}

}  // namespace

std::vector<std::string> given_keys(const Selection& s) {
  std::vector<std::string> given;
  if (s.face) given.emplace_back("face");
  if (s.box) given.emplace_back("box");
  if (s.point) given.emplace_back("point");
  if (!s.surface.empty()) given.emplace_back("surface");
  if (!s.named.empty()) given.emplace_back("selection");
  if (s.sphere) given.emplace_back("sphere");
  if (s.cylinder) given.emplace_back("cylinder");
  if (s.half_space) given.emplace_back("half_space");
  if (!s.any_of.empty()) given.emplace_back("union");
  if (!s.all_of.empty()) given.emplace_back("intersection");
  if (!s.first_of.empty()) given.emplace_back("difference");
  return given;
}

void check_selection(const Checker& check, const std::string& path, const std::string& title,
                     const Selection& selection, std::size_t known) {
  const std::vector<std::string> given = given_keys(selection);
  const std::string keys = path.starts_with("selection") ? "face, box, point, sphere, cylinder, half_space, surface, "
                                                           "union, intersection, difference"
                                                         : "face, box, point, surface, selection";
  if (given.empty()) check.fail(path, fmt::format("{} selects nothing; give one of {}", title, keys));
  if (given.size() > 1)
    check.fail(path + "." + given[1],
               fmt::format("{} has both {}; give one of {}", title, fmt::join(given, " and "), keys));
  check_shapes(check, path, selection);

  const Definition& definition = check.definition;
  if (!selection.surface.empty()) {
    std::vector<std::string> regions;
    for (const RegionDefinition& region : definition.regions)
      if (!region.name.empty()) regions.push_back(region.name);
    check_reference(check, path + ".surface", "region", selection.surface, regions);
  }
  const std::vector<std::string> selections = names_of_selections(definition, known);
  if (!selection.named.empty()) check_reference(check, path + ".selection", "selection", selection.named, selections);
  for (const auto* list : {&selection.any_of, &selection.all_of, &selection.first_of})
    for (const std::string& name : *list)
      check_reference(check, path + "." + given[0], "selection before this one", name, selections);
}

void check_selection(const Checker& check, const std::string& path, const std::string& title,
                     const Selection& selection) {
  check_selection(check, path, title, selection, check.definition.selections.size());
}

void check_named_selection(const Checker& check, const std::string& path, const std::string& name) {
  check_reference(check, path, "selection", name,
                  names_of_selections(check.definition, check.definition.selections.size()));
}

void check_selections(const Checker& check) {
  const Definition& definition = check.definition;
  const auto unlike = [&](const std::string& kind, std::size_t i, const std::string& name, std::set<std::string>& all) {
    if (!all.insert(name).second)
      check.fail(fmt::format("{}[{}].name", kind, i),
                 fmt::format("two {} tables are called \"{}\"; names must differ", kind, name));
  };
  std::set<std::string> regions, selections;
  for (std::size_t r = 0; r < definition.regions.size(); ++r)
    if (!definition.regions[r].name.empty()) unlike("region", r, definition.regions[r].name, regions);
  for (std::size_t s = 0; s < definition.selections.size(); ++s) {
    const SelectionDefinition& one = definition.selections[s];
    const std::string path = fmt::format("selection[{}]", s);
    if (one.name.empty())
      check.fail(path + ".name", "the name of a selection is empty; give it a name, such as \"wall\"");
    unlike("selection", s, one.name, selections);
    // Only to those before it: so no selection stands for itself.
    check_selection(check, path, fmt::format("selection \"{}\"", one.name), one.selection, s);
  }
}

}  // namespace koshi::model
