// Keys of what differs from cell to cell: [material.NAME.stiffness_scatter], [material.NAME.fracture.strength_scatter]
// and [body.grain_boundary].
#include "io/toml/key.h"

namespace koshi::io {

using namespace model;

const std::vector<Key<material::Scatter>>& keys_of(Tag<material::Scatter>) {
  using D = material::Scatter;
  const auto of = [](material::Distribution distribution, Key<D> key) {
    return std::move(key).only_for("distribution " + toml_text(choice_name(distribution)), {"distribution"},
                                   [distribution](const D& scatter) { return scatter.distribution == distribution; });
  };
  static const std::vector<Key<D>> keys{
      key<D>("distribution", &D::distribution, "Of the random factors, whose mean is 1."),
      of(material::Distribution::weibull,
         key<D>("modulus", &D::modulus, "Weibull's m: the larger, the less the factors differ.",
                {.required = true, .range = ranges::weibull_modulus, .example = "10"})),
      of(material::Distribution::normal,
         key<D>("variation", &D::variation, "Standard deviation over mean; factors end at three of them.",
                {.required = true, .range = ranges::variation, .example = "0.1"})),
      key<D>("correlation_length", &D::correlation_length,
             "Cells r apart are correlated by exp(-(r/l)^2); 0: each cell has a factor of its own.",
             {.dimension = Dimension::length, .range = ranges::correlation_length, .example = R"("6 mm")"}),
      key<D>("seed", &D::seed, "Of the random numbers; equal seeds give equal numbers.",
             {.range = ranges::seed, .example = "7"}),
  };
  return keys;
}

const std::vector<Key<GrainBoundaryDefinition>>& keys_of(Tag<GrainBoundaryDefinition>) {
  using D = GrainBoundaryDefinition;
  const std::vector<std::string> effects{"material", "strength"};
  static const std::vector<Key<D>> keys{
      key<D>("labels", &D::labels,
             "File of whole numbers, one for each grain, in the formats of an image; unset: a grain is what has one "
             "material.",
             {.example = R"("grains.npy")"}),
      key<D>("material", &D::material, "Material that cells with a face neighbour of another grain become.",
             {.example = R"("cement")", .one_of = effects}),
      key<D>("strength", &D::strength, "Factor on the strength of these cells.",
             {.range = ranges::strength_share, .example = "0.5", .one_of = effects}),
  };
  return keys;
}

}  // namespace koshi::io
