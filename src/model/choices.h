// The words that stand for enumerators in input and output: one list per enumeration.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "koshi/definition.h"

namespace koshi::model {

template <class E>
struct Choice {
  std::string_view name;
  E value;
};

template <class E>
inline constexpr auto choices = nullptr;

template <>
inline constexpr auto choices<lattice::CellType> = std::to_array<Choice<lattice::CellType>>({
    {name(lattice::CellType::cube_i), lattice::CellType::cube_i},
    {name(lattice::CellType::cube_ii), lattice::CellType::cube_ii},
    {name(lattice::CellType::cube_iii), lattice::CellType::cube_iii},
});

template <>
inline constexpr auto choices<material::Sharing> = std::to_array<Choice<material::Sharing>>(
    {{"shared", material::Sharing::shared}, {"plain", material::Sharing::plain}});

template <>
inline constexpr auto choices<material::Calibration> = std::to_array<Choice<material::Calibration>>({
    {"bending-exact", material::Calibration::bending_exact},
    {"beam-exact", material::Calibration::beam_exact},
    {"isotropic", material::Calibration::isotropic},
    {"paper", material::Calibration::paper},
});

template <>
inline constexpr auto choices<material::Kinematics> = std::to_array<Choice<material::Kinematics>>(
    {{"rotational", material::Kinematics::rotational}, {"least-squares", material::Kinematics::least_squares}});

template <>
inline constexpr auto choices<material::FractureLaw> =
    std::to_array<Choice<material::FractureLaw>>({{"cohesive", material::FractureLaw::cohesive},
                                                  {"bonds", material::FractureLaw::bonds},
                                                  {"none", material::FractureLaw::none}});

template <>
inline constexpr auto choices<material::Softening> = std::to_array<Choice<material::Softening>>(
    {{"exponential", material::Softening::exponential}, {"linear", material::Softening::linear}});

template <>
inline constexpr auto choices<material::Distribution> = std::to_array<Choice<material::Distribution>>(
    {{"weibull", material::Distribution::weibull}, {"normal", material::Distribution::normal}});

template <>
inline constexpr auto choices<RegionDefinition::Shape> = std::to_array<Choice<RegionDefinition::Shape>>({
    {"box", RegionDefinition::Shape::box},
    {"sphere", RegionDefinition::Shape::sphere},
    {"cylinder", RegionDefinition::Shape::cylinder},
    {"half-space", RegionDefinition::Shape::half_space},
    {"stl", RegionDefinition::Shape::stl},
});

template <>
inline constexpr auto choices<ScanDefinition::Type> = std::to_array<Choice<ScanDefinition::Type>>({
    {"int8", ScanDefinition::Type::int8},
    {"uint8", ScanDefinition::Type::uint8},
    {"int16", ScanDefinition::Type::int16},
    {"uint16", ScanDefinition::Type::uint16},
    {"int32", ScanDefinition::Type::int32},
    {"uint32", ScanDefinition::Type::uint32},
    {"float32", ScanDefinition::Type::float32},
    {"float64", ScanDefinition::Type::float64},
});

template <>
inline constexpr auto choices<ScanDefinition::ByteOrder> = std::to_array<Choice<ScanDefinition::ByteOrder>>(
    {{"little", ScanDefinition::ByteOrder::little}, {"big", ScanDefinition::ByteOrder::big}});

template <>
inline constexpr auto choices<CrackDefinition::Shape> = std::to_array<Choice<CrackDefinition::Shape>>(
    {{"disc", CrackDefinition::Shape::disc}, {"rectangle", CrackDefinition::Shape::rectangle}});
template <>
inline constexpr auto choices<BodyDefinition::Surface> = std::to_array<Choice<BodyDefinition::Surface>>(
    {{"stairs", BodyDefinition::Surface::stairs}, {"cut", BodyDefinition::Surface::cut}});

template <>
inline constexpr auto choices<Face> = std::to_array<Choice<Face>>({
    {"x-min", Face::x_min},
    {"x-max", Face::x_max},
    {"y-min", Face::y_min},
    {"y-max", Face::y_max},
    {"z-min", Face::z_min},
    {"z-max", Face::z_max},
});

template <>
inline constexpr auto choices<BoundaryDefinition::Support> = std::to_array<Choice<BoundaryDefinition::Support>>(
    {{"roller", BoundaryDefinition::Support::roller}, {"bonded", BoundaryDefinition::Support::bonded}});

template <>
inline constexpr auto choices<LoadDefinition::Distribution> = std::to_array<Choice<LoadDefinition::Distribution>>(
    {{"area", LoadDefinition::Distribution::area}, {"nodes", LoadDefinition::Distribution::nodes}});

template <>
inline constexpr auto choices<DampingDefinition::Kind> = std::to_array<Choice<DampingDefinition::Kind>>({
    {"local", DampingDefinition::Kind::local},
    {"viscous", DampingDefinition::Kind::viscous},
    {"none", DampingDefinition::Kind::none},
});

template <>
inline constexpr auto choices<AnalysisDefinition::Type> = std::to_array<Choice<AnalysisDefinition::Type>>({
    {"static", AnalysisDefinition::Type::statics},
    {"quasi-static", AnalysisDefinition::Type::quasi_static},
    {"dynamic", AnalysisDefinition::Type::dynamic},
    {"modes", AnalysisDefinition::Type::modes},
});

template <>
inline constexpr auto choices<ProbeDefinition::Quantity> = std::to_array<Choice<ProbeDefinition::Quantity>>({
    {"displacement", ProbeDefinition::Quantity::displacement},
    {"rotation", ProbeDefinition::Quantity::rotation},
    {"velocity", ProbeDefinition::Quantity::velocity},
    {"reaction", ProbeDefinition::Quantity::reaction},
    {"moment", ProbeDefinition::Quantity::moment},
    {"stress", ProbeDefinition::Quantity::stress},
    {"strain", ProbeDefinition::Quantity::strain},
});

template <>
inline constexpr auto choices<ProbeDefinition::Reduce> = std::to_array<Choice<ProbeDefinition::Reduce>>({
    {"mean", ProbeDefinition::Reduce::mean},
    {"area-mean", ProbeDefinition::Reduce::area_mean},
    {"sum", ProbeDefinition::Reduce::sum},
    {"max", ProbeDefinition::Reduce::max},
    {"percentile", ProbeDefinition::Reduce::percentile},
});

/// The word for an enumerator.
template <class E>
std::string choice_name(E value) {
  for (const auto& choice : choices<E>)
    if (choice.value == value) return std::string(choice.name);
  return {};
}

/// All words of an enumeration.
template <class E>
std::vector<std::string> choice_names() {
  std::vector<std::string> names;
  names.reserve(choices<E>.size());
  for (const auto& choice : choices<E>) names.emplace_back(choice.name);
  return names;
}

/// Components of motion, in the order of BoundaryDefinition: displacements, then rotations.
inline constexpr std::array<std::string_view, 6> component_names{"x", "y", "z", "rx", "ry", "rz"};

/// Fields that OutputDefinition::fields may list.
inline constexpr std::array<std::string_view, 11> field_names{"displacement", "rotation", "orientation",  "velocity",
                                                              "reaction",     "strain",   "stress",       "material",
                                                              "energy",       "damage",   "crack_opening"};

}  // namespace koshi::model
