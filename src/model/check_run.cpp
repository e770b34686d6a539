// Checks of the analysis and the output; the whole check.
#include <fmt/format.h>

#include <algorithm>

#include "base/suggest.h"
#include "model/check.h"
#include "model/choices.h"

namespace koshi::model {

void check_run(const Checker& check) {
  const AnalysisDefinition& analysis = check.definition.analysis;
  if (!(analysis.tolerance > 0 && analysis.tolerance < 1))
    check.fail("analysis.tolerance",
               fmt::format("tolerance is {:.12g}; it must lie between 0 and 1, such as 1e-8", analysis.tolerance));
  if (analysis.type == AnalysisDefinition::Type::dynamic && !analysis.duration)
    check.fail("analysis", "a dynamic analysis has no duration; give one, such as duration = \"0.1 s\"");
  check.positive("analysis.duration", analysis.duration, "s");
  check.positive("analysis.time_step", analysis.time_step, "s");
  if (!(analysis.safety > 0 && analysis.safety <= 1))
    check.fail("analysis.safety",
               fmt::format("safety is {:.12g}; it must be above 0 and at most 1, such as 0.9", analysis.safety));
  const double factor = analysis.damping.factor;
  if (!(factor >= 0 && factor < 1))
    check.fail("analysis.damping.factor",
               fmt::format("factor is {:.12g}; local damping takes 0 to below 1, such as 0.8", factor));
  check.not_negative("analysis.damping.rate", analysis.damping.rate, "1/s");

  const OutputDefinition& output = check.definition.output;
  const std::vector<std::string> known(field_names.begin(), field_names.end());
  for (std::size_t i = 0; i < output.fields.size(); ++i)
    if (std::find(known.begin(), known.end(), output.fields[i]) == known.end())
      check.fail(fmt::format("output.fields[{}]", i),
                 fmt::format("there is no field \"{}\"; {}", output.fields[i], suggestion(output.fields[i], known)));
  check.positive("output.every", output.every, "s");
  check.positive("output.history_every", output.history_every, "s");
  check.positive("output.checkpoint_every", output.checkpoint_every, "s");
  check.positive("output.checkpoint_every_wall", output.checkpoint_wall, "s");
}

void check(const Definition& definition) {
  const Checker checker(definition);
  check_body(checker);
  check_conditions(checker);
  check_run(checker);
}

}  // namespace koshi::model
