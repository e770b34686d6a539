// Keys of [[crack]] and [analysis.stop_when].
#include "io/toml/key.h"

namespace koshi::io {

using namespace model;

const std::vector<Key<CrackDefinition>>& keys_of(Tag<CrackDefinition>) {
  using D = CrackDefinition;
  const auto of = [](D::Shape shape, Key<D> key) {
    return std::move(key).only_for("shape " + toml_text(choice_name(shape)), {"shape"},
                                   [shape](const D& crack) { return crack.shape == shape; });
  };
  const auto size = [](const std::string& example) {
    return About{.dimension = Dimension::length, .required = true, .range = ranges::size, .example = example};
  };
  static const std::vector<Key<D>> keys{
      key<D>("name", &D::name, "For messages.", {.example = R"("flaw")"}),
      key<D>("shape", &D::shape, "Piece of a plane that cracks the cells it cuts."),
      key<D>("center", &D::center, "Centre of the piece.",
             {.dimension = Dimension::length,
              .required = true,
              .range = ranges::position,
              .example = R"(["25 mm", "0 mm", "5 mm"])"}),
      key<D>("normal", &D::normal, "Direction across the plane.",
             {.required = true, .range = ranges::direction, .example = "[1, 0, 0]"}),
      of(D::Shape::disc, key<D>("radius", &D::radius, "Radius.", size(R"("10 mm")"))),
      of(D::Shape::rectangle, key<D>("along", &D::along, "Direction of the length; what of it lies in the plane.",
                                     {.required = true, .range = ranges::direction, .example = "[0, 1, 0]"})),
      of(D::Shape::rectangle, key<D>("length", &D::length, "Side along that direction.", size(R"("50 mm")"))),
      of(D::Shape::rectangle, key<D>("width", &D::width, "Other side.", size(R"("10 mm")"))),
  };
  return keys;
}

const std::vector<Key<StopDefinition>>& keys_of(Tag<StopDefinition>) {
  using D = StopDefinition;
  static const std::vector<Key<D>> keys{
      key<D>("probe", &D::probe, "Name of a probe of a reaction that is looked at.", {.example = R"("pull")"}),
      key<D>("below", &D::below, "The run ends when the reaction has fallen below this part of its largest.",
             {.required = true, .range = ranges::part_of_peak, .example = "0.2"})
          .only_for("a probe", {"probe"}, [](const D& stop) { return !stop.probe.empty(); }),
      key<D>("face", &D::face, "The run ends when a cell at this face of the box has cracked through."),
      key<D>("after", &D::after, "Nothing ends the run before.",
             {.dimension = Dimension::time, .range = ranges::moment, .example = R"("1 ms")"}),
  };
  return keys;
}

}  // namespace koshi::io
