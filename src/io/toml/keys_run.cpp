// Keys of [analysis], its damping, and [output].
#include "io/toml/key.h"

namespace koshi::io {

using namespace model;

const std::vector<Key<AnalysisDefinition>>& keys_of(Tag<AnalysisDefinition>) {
  using D = AnalysisDefinition;
  using Type = D::Type;
  const auto stepped = [](const D& analysis) { return analysis.stepped(); };
  const auto of_stepped = [&](Key<D> key) {
    return std::move(key).only_for("type \"quasi-static\" or \"dynamic\"", {"type"}, stepped);
  };
  const auto of_runs = [](Key<D> key) {
    return std::move(key).only_for("type \"static\", \"quasi-static\" or \"dynamic\"", {"type"},
                                   [](const D& analysis) { return analysis.type != Type::modes; });
  };
  const auto of_modes = [](Key<D> key) {
    return std::move(key).only_for("type \"modes\"", {"type"},
                                   [](const D& analysis) { return analysis.type == Type::modes; });
  };
  static const std::vector<Key<D>> keys{
      key<D>("type", &D::type,
             "Equilibrium solved directly, equilibrium reached by damped stepping, motion over time, or natural "
             "frequencies."),
      key<D>("tolerance", &D::tolerance,
             "Static: relative residual of the solution; quasi-static: unbalanced-force ratio at rest; modes: relative "
             "error of the squared frequencies.",
             {.range = ranges::tolerance, .example = "1e-6"})
          .only_for("type \"static\", \"quasi-static\" or \"modes\"", {"type"},
                    [](const D& analysis) { return analysis.type != Type::dynamic; }),
      of_stepped(key<D>("duration", &D::duration,
                        "Simulated time; required for dynamic, the most that quasi-static may take.",
                        {.dimension = Dimension::time, .range = ranges::time, .example = R"("0.32 s")"})),
      of_stepped(key<D>("time_step", &D::time_step, "Time step; \"auto\": the stable limit times safety.",
                        {.dimension = Dimension::time, .unset_word = "auto", .range = ranges::time})),
      of_stepped(key<D>("allow_unstable_step", &D::allow_unstable_step,
                        "Run with a time step above the stable limit all the same.")),
      of_stepped(key<D>("safety", &D::safety, "Ratio of the automatic time step to the stable limit.",
                        {.range = ranges::safety, .example = "0.9"})),
      of_stepped(key<D>("damping", &D::damping,
                        "Damping of the motion; unset: local with factor 0.8 for quasi-static, none for dynamic.",
                        {.title = "damping", .example = R"({kind = "local", factor = 0.8})"})),
      key<D>("steps", &D::steps,
             "Of a body that can crack: equal steps through the histories of loads and motions, each with the cracks "
             "that its equilibrium has; unset: event by event.",
             {.range = ranges::event_count, .example = "50"})
          .only_for("type \"static\"", {"type"}, [](const D& analysis) { return analysis.type == Type::statics; }),
      key<D>("events", &D::events,
             "Of a body that can crack: the most events, in each of which the next cells crack and the equilibrium is "
             "found anew.",
             {.range = ranges::event_count, .example = "1000"})
          .only_for("type \"static\" without steps", {"type", "steps"},
                    [](const D& analysis) { return analysis.type == Type::statics && !analysis.steps; }),
      of_runs(key<D>("stop_when", &D::stop_when, "What ends the run before its time; unset: nothing.",
                     {.title = "stop_when", .example = R"({probe = "pull", below = 0.2})"})),
      of_runs(key<D>("start_from", &D::start_from,
                     "Output directory of an earlier run whose displacements are the start of this one.",
                     {.example = R"("out/loaded")"})),
      of_modes(key<D>("count", &D::count, "Number of modes.", {.range = ranges::mode_count, .example = "10"})),
      of_modes(key<D>("near", &D::near, "The modes closest to this frequency, of the 200 lowest; \"0 Hz\": the lowest.",
                      {.dimension = Dimension::rate, .range = ranges::frequency, .example = R"("0 Hz")"})),
      of_modes(key<D>("allow_floating", &D::allow_floating,
                      "Go on with a body in several parts of which some are free to move.")),
  };
  return keys;
}

const std::vector<Key<DampingDefinition>>& keys_of(Tag<DampingDefinition>) {
  using D = DampingDefinition;
  using Kind = D::Kind;
  static const std::vector<Key<D>> keys{
      key<D>("kind", &D::kind, "Local non-viscous damping, viscous damping, or none."),
      key<D>("factor", &D::factor, "Part of the unbalanced force that is taken away.",
             {.range = ranges::damping_factor, .example = "0.8"})
          .only_for("kind \"local\"", {"kind"}, [](const D& damping) { return damping.kind == Kind::local; }),
      key<D>("rate", &D::rate, "Damping force over mass times velocity.",
             {.dimension = Dimension::rate, .required = true, .range = ranges::damping_rate})
          .only_for("kind \"viscous\"", {"kind"}, [](const D& damping) { return damping.kind == Kind::viscous; }),
  };
  return keys;
}

const std::vector<Key<OutputDefinition>>& keys_of(Tag<OutputDefinition>) {
  using D = OutputDefinition;
  const About time{.dimension = Dimension::time, .range = ranges::time, .example = R"("10 ms")"};
  static const std::vector<Key<D>> keys{
      key<D>("fields", &D::fields, "Fields to write.",
             {.allowed = {field_names.begin(), field_names.end()}, .example = R"(["displacement", "stress"])"}),
      key<D>("every", &D::every, "Simulated time between samples of the fields; unset: the end only.", time),
      key<D>("every_events", &D::every_events,
             "Of a static body that cracks: events between samples of the fields; unset: the end only.",
             {.range = ranges::event_count, .example = "50"}),
      key<D>("history_every", &D::history_every,
             "Simulated time between rows of history.csv; unset: about 200 rows in all.", time),
      key<D>("checkpoint_every", &D::checkpoint_every, "Simulated time between checkpoints.", time),
      key<D>("checkpoint_every_wall", &D::checkpoint_wall, "Wall time between checkpoints.",
             {.dimension = Dimension::time, .range = ranges::time, .example = R"("1 hour")"}),
      key<D>("report", &D::report, "Write report.html at the end."),
      key<D>("crack_surface", &D::crack_surface,
             "Write the surface of the cracks with each sample, where a material can crack."),
      key<D>("surface", &D::surface,
             "Write the surface of the regions, with displacement and stress on it, with each sample."),
  };
  return keys;
}

}  // namespace koshi::io
