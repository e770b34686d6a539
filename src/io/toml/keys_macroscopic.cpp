// Keys of [macroscopic].
#include "io/toml/key.h"

namespace koshi::io {

using namespace model;

namespace {

// The six components, each by its name.
template <class D>
std::vector<Key<D>> components(const std::string& what, const About& about) {
  return {
      key<D>(
          "xx", [](auto& t) -> auto& { return t.components[0]; }, what + " along x.", about),
      key<D>(
          "yy", [](auto& t) -> auto& { return t.components[1]; }, what + " along y.", about),
      key<D>(
          "zz", [](auto& t) -> auto& { return t.components[2]; }, what + " along z.", about),
      key<D>(
          "yz", [](auto& t) -> auto& { return t.components[3]; }, what + " of shear between y and z.", about),
      key<D>(
          "xz", [](auto& t) -> auto& { return t.components[4]; }, what + " of shear between x and z.", about),
      key<D>(
          "xy", [](auto& t) -> auto& { return t.components[5]; }, what + " of shear between x and y.", about),
  };
}

}  // namespace

const std::vector<Key<MacroscopicDefinition>>& keys_of(Tag<MacroscopicDefinition>) {
  using D = MacroscopicDefinition;
  static const std::vector<Key<D>> keys{
      key<D>("strain", &D::strain, "Components of the mean strain; those that are neither here nor in stress are zero.",
             {.title = "strain", .example = "{xx = 0.001, xy = 0}"}),
      key<D>("stress", &D::stress, "Components of the mean stress over the box, voids too; their strains are found.",
             {.title = "stress", .example = R"({yy = "0 Pa", zz = "-10 MPa"})"}),
      key<D>("history", &D::history,
             "Factor on both over time: pairs [time, factor], linear between, constant outside.",
             {.example = R"([["0 s", 0], ["1 s", 1]])"}),
  };
  return keys;
}

const std::vector<Key<MeanStrain>>& keys_of(Tag<MeanStrain>) {
  static const auto keys =
      components<MeanStrain>("Component of the tensor", {.range = ranges::mean_strain, .example = "0.001"});
  return keys;
}

const std::vector<Key<MeanStress>>& keys_of(Tag<MeanStress>) {
  static const auto keys = components<MeanStress>(
      "Mean stress", {.dimension = Dimension::pressure, .range = ranges::pressure, .example = R"("-10 MPa")"});
  return keys;
}

}  // namespace koshi::io
