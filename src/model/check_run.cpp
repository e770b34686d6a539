// Checks of the analysis and the output; the whole check.
#include <fmt/format.h>

#include <algorithm>

#include "base/suggest.h"
#include "model/check.h"
#include "model/choices.h"

namespace koshi::model {

namespace {

// A mode is a shape without a time.
void check_output_of_modes(const Checker& check) {
  const OutputDefinition& output = check.definition.output;
  for (std::size_t i = 0; i < output.fields.size(); ++i)
    for (const char* field : {"velocity", "orientation", "reaction"})
      if (output.fields[i] == field)
        check.fail(
            fmt::format("output.fields[{}]", i),
            fmt::format("a mode is a shape and has no field \"{}\"; take displacement, rotation, strain, stress, "
                        "energy or material",
                        field));
  const auto refuse = [&](const char* key, bool given) {
    if (given)
      check.fail(fmt::format("output.{}", key),
                 fmt::format("{} belongs to runs that go on in time; the search for modes keeps nothing on its way: "
                             "leave it out",
                             key));
  };
  refuse("every", output.every.has_value());
  refuse("history_every", output.history_every.has_value());
  refuse("checkpoint_every", output.checkpoint_every.has_value());
  refuse("checkpoint_every_wall", output.checkpoint_wall.has_value());
}

// Whether a load or a motion changes with time.
bool changes(const Definition& definition) {
  const auto lasts = [](const auto& condition) {
    return !condition.history.empty() && condition.history.back()[0] > 0;
  };
  return std::ranges::any_of(definition.loads, lasts) || std::ranges::any_of(definition.boundaries, lasts) ||
         std::ranges::any_of(definition.boundaries, [](const BoundaryDefinition& b) { return b.ramp > 0; });
}

void check_steps(const Checker& check) {
  const std::optional<int>& steps = check.definition.analysis.steps;
  if (!steps) return;
  check.within(ranges::event_count, "analysis.steps", *steps);
  if (!check.definition.cracks())
    check.fail("analysis.steps",
               "steps follow the cracks of a body through its loads, and no material of this one can crack; such an "
               "equilibrium is found at once: give a material a fracture, or leave steps out");
  if (!changes(check.definition))
    check.fail("analysis.steps",
               "steps go through the histories of loads and motions, and there is none that takes time; give what "
               "grows a history, such as history = [[\"0 s\", 0], [\"1 s\", 1]]");
}

}  // namespace

void check_run(const Checker& check) {
  const AnalysisDefinition& analysis = check.definition.analysis;
  check.within(ranges::tolerance, "analysis.tolerance", analysis.tolerance);
  if (analysis.type == AnalysisDefinition::Type::dynamic && !analysis.duration)
    check.fail("analysis", "a dynamic analysis has no duration; give one, such as duration = \"0.1 s\"");
  check.within(ranges::time, "analysis.duration", analysis.duration);
  check.within(ranges::time, "analysis.time_step", analysis.time_step);
  check.within(ranges::safety, "analysis.safety", analysis.safety);
  check.within(ranges::damping_factor, "analysis.damping.factor", analysis.damping.factor);
  check.within(ranges::damping_rate, "analysis.damping.rate", analysis.damping.rate);

  check.within(ranges::event_count, "analysis.events", analysis.events);
  check_steps(check);
  check.within(ranges::mode_count, "analysis.count", analysis.count);
  check.within(ranges::frequency, "analysis.near", analysis.near);
  if (analysis.type == AnalysisDefinition::Type::modes) check_output_of_modes(check);

  const OutputDefinition& output = check.definition.output;
  const std::vector<std::string> known(field_names.begin(), field_names.end());
  for (std::size_t i = 0; i < output.fields.size(); ++i)
    if (std::find(known.begin(), known.end(), output.fields[i]) == known.end())
      check.fail(fmt::format("output.fields[{}]", i),
                 fmt::format("there is no field \"{}\"; {}", output.fields[i], suggestion(output.fields[i], known)));
    else if ((output.fields[i] == "damage" || output.fields[i] == "crack_opening") && !check.definition.cracks())
      check.fail(fmt::format("output.fields[{}]", i),
                 fmt::format("{} belongs to materials that crack, and there is none; give one a fracture, or leave {} "
                             "out",
                             output.fields[i], output.fields[i]));
  if (output.surface && check.definition.regions.empty())
    check.fail("output.surface",
               "surface is that of the regions, and there are none; make the body of regions, or leave it out");
  check.within(ranges::time, "output.every", output.every);
  if (output.every_events) check.within(ranges::event_count, "output.every_events", *output.every_events);
  if (output.every_events && !check.definition.follows_events())
    check.fail("output.every_events",
               "every_events counts the events of a static body that cracks without steps, and this is none; samples "
               "of a run in time or in steps are taken by every");
  check.within(ranges::time, "output.history_every", output.history_every);
  check.within(ranges::time, "output.checkpoint_every", output.checkpoint_every);
  check.within(ranges::time, "output.checkpoint_every_wall", output.checkpoint_wall);
}

void check(const Definition& definition) {
  const Checker checker(definition);
  check_body(checker);
  check_conditions(checker);
  check_cracks(checker);
  check_macroscopic(checker);
  check_run(checker);
}

}  // namespace koshi::model
