// Every number of the input has a unit and a valid range: the schema tells it, the reader and the check keep it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "io/toml/key.h"
#include "koshi/input.h"
#include "support/broken_input.h"

namespace koshi::io {
namespace {

using Json = nlohmann::json;
using testing::HasSubstr;

constexpr double infinity = std::numeric_limits<double>::infinity();

// The numbers of a schema by path; elements of a list add nothing to it but those of a pair, which differ.
void collect(const std::string& path, const Json& schema, std::map<std::string, Json>& numbers) {
  if (schema.value("type", Json()) == Json({"number", "string"})) numbers[path] = schema;
  if (schema.contains("properties"))
    for (const auto& [key, value] : schema.at("properties").items())
      collect(path.empty() ? key : path + "." + key, value, numbers);
  if (schema.contains("additionalProperties") && schema.at("additionalProperties").is_object())
    collect(path, schema.at("additionalProperties"), numbers);
  if (!schema.contains("items")) return;
  const Json& items = schema.at("items");
  collect(path, items, numbers);
  if (items.contains("prefixItems"))
    for (std::size_t i = 0; i < items.at("prefixItems").size(); ++i)
      collect(fmt::format("{}.{}", path, i), items.at("prefixItems")[i], numbers);
}

std::map<std::string, Json> numbers_of_schema() {
  std::map<std::string, Json> numbers;
  collect("", Json::parse(schema_json()), numbers);
  return numbers;
}

// Where each number stands in a case of the corpus, as a path of --set.
const std::map<std::string, std::string>& places() {
  static const std::map<std::string, std::string> places{
      {"lattice.spacing", "lattice.spacing"},
      {"body.origin", "body.origin.1"},
      {"body.size", "body.size.1"},
      {"body.scan.size", "body.scan.size"},
      {"body.scan.unit", "body.scan.unit"},
      {"body.scan.crop.min", "body.scan.crop"},
      {"body.scan.crop.max", "body.scan.crop"},
      {"body.scan.thresholds", "body.scan.thresholds"},
      {"body.scan.grey", "body.scan.grey"},
      {"body.scan.density", "body.scan.density"},
      {"body.scan.exponent", "body.scan.exponent"},
      {"material.youngs_modulus", "material.soft.youngs_modulus"},
      {"material.poissons_ratio", "material.soft.poissons_ratio"},
      {"material.density", "material.soft.density"},
      {"material.fracture.tensile_strength", "material.soft.fracture.tensile_strength"},
      {"material.fracture.fracture_energy", "material.soft.fracture.fracture_energy"},
      {"material.fracture.critical_stretch", "material.soft.fracture.critical_stretch"},
      {"material.fracture.critical_shear", "material.soft.fracture.critical_shear"},
      {"material.fracture.cohesion", "material.soft.fracture.cohesion"},
      {"material.fracture.friction_angle", "material.soft.fracture.friction_angle"},
      {"material.fracture.residual_friction_angle", "material.soft.fracture.residual_friction_angle"},
      {"material.fracture.strength_scatter.modulus", "material.soft.fracture.strength_scatter.modulus"},
      {"material.fracture.strength_scatter.variation", "material.soft.fracture.strength_scatter.variation"},
      {"material.fracture.strength_scatter.correlation_length",
       "material.soft.fracture.strength_scatter.correlation_length"},
      {"material.stiffness_scatter.modulus", "material.soft.stiffness_scatter.modulus"},
      {"material.stiffness_scatter.variation", "material.soft.stiffness_scatter.variation"},
      {"material.stiffness_scatter.correlation_length", "material.soft.stiffness_scatter.correlation_length"},
      {"body.grain_boundary.strength", "body.grain_boundary.strength"},
      {"crack.center", "crack.0.center.1"},
      {"crack.normal", "crack.0.normal.1"},
      {"crack.radius", "crack.0.radius"},
      {"crack.along", "crack.1.along.2"},
      {"crack.length", "crack.1.length"},
      {"crack.width", "crack.1.width"},
      {"region.min", "region.0.min.0"},
      {"region.max", "region.0.max.2"},
      {"region.center", "region.1.center.1"},
      {"region.radius", "region.1.radius"},
      {"region.start", "region.2.start.1"},
      {"region.end", "region.2.end.2"},
      {"region.point", "region.3.point.0"},
      {"region.normal", "region.3.normal.2"},
      {"region.scale", "region.4.scale"},
      {"selection.box.min", "selection.all.box"},
      {"selection.box.max", "selection.all.box"},
      {"selection.point", "selection.corner.point"},
      {"selection.sphere.center", "selection.ball.sphere.center"},
      {"selection.sphere.radius", "selection.ball.sphere.radius"},
      {"selection.cylinder.start", "selection.bar.cylinder.start.0"},
      {"selection.cylinder.end", "selection.bar.cylinder.end.0"},
      {"selection.cylinder.radius", "selection.bar.cylinder.radius"},
      {"selection.half_space.point", "selection.half.half_space.point"},
      {"selection.half_space.normal", "selection.half.half_space.normal.2"},
      {"boundary.box.min", "boundary.turned.box.min.0"},
      {"boundary.box.max", "boundary.turned.box.max.2"},
      {"boundary.point", "boundary.held.point"},
      {"boundary.displacement.x", "boundary.1.displacement.x"},
      {"boundary.displacement.y", "boundary.1.displacement.y"},
      {"boundary.displacement.z", "boundary.1.displacement.z"},
      {"boundary.displacement.rx", "boundary.1.displacement.rx"},
      {"boundary.displacement.ry", "boundary.1.displacement.ry"},
      {"boundary.displacement.rz", "boundary.1.displacement.rz"},
      {"boundary.velocity.x", "boundary.1.velocity.x"},
      {"boundary.velocity.y", "boundary.1.velocity.y"},
      {"boundary.velocity.z", "boundary.1.velocity.z"},
      {"boundary.velocity.rx", "boundary.1.velocity.rx"},
      {"boundary.velocity.ry", "boundary.1.velocity.ry"},
      {"boundary.velocity.rz", "boundary.1.velocity.rz"},
      {"boundary.twist.x", "boundary.turned.twist.x"},
      {"boundary.twist.y", "boundary.turned.twist.y"},
      {"boundary.twist.z", "boundary.turned.twist.z"},
      {"boundary.center", "boundary.turned.center.0"},
      {"boundary.ramp", "boundary.1.ramp"},
      {"boundary.history.0", "boundary.1.history.2.0"},
      {"boundary.history.1", "boundary.1.history.1.1"},
      {"load.box.min", "load.wind.box"},
      {"load.box.max", "load.wind.box"},
      {"load.point", "load.0.point"},
      {"load.force", "load.0.force.0"},
      {"load.traction", "load.wind.traction.1"},
      {"load.pressure", "load.water.pressure"},
      {"load.acceleration", "load.weight.acceleration.2"},
      {"load.history.0", "load.0.history.1.0"},
      {"load.history.1", "load.0.history.1.1"},
      {"macroscopic.strain.xx", "macroscopic.strain.xx"},
      {"macroscopic.strain.yy", "macroscopic.strain.yy"},
      {"macroscopic.strain.zz", "macroscopic.strain.zz"},
      {"macroscopic.strain.yz", "macroscopic.strain.yz"},
      {"macroscopic.strain.xz", "macroscopic.strain.xz"},
      {"macroscopic.strain.xy", "macroscopic.strain.xy"},
      {"macroscopic.stress.xx", "macroscopic.stress.xx"},
      {"macroscopic.stress.yy", "macroscopic.stress.yy"},
      {"macroscopic.stress.zz", "macroscopic.stress.zz"},
      {"macroscopic.stress.yz", "macroscopic.stress.yz"},
      {"macroscopic.stress.xz", "macroscopic.stress.xz"},
      {"macroscopic.stress.xy", "macroscopic.stress.xy"},
      {"macroscopic.history.0", "macroscopic.history.1.0"},
      {"macroscopic.history.1", "macroscopic.history.1.1"},
      {"analysis.tolerance", "analysis.tolerance"},
      {"analysis.duration", "analysis.duration"},
      {"analysis.time_step", "analysis.time_step"},
      {"analysis.safety", "analysis.safety"},
      {"analysis.stop_when.below", "analysis.stop_when.below"},
      {"analysis.stop_when.after", "analysis.stop_when.after"},
      {"analysis.near", "analysis.near"},
      {"analysis.damping.factor", "analysis.damping.factor"},
      {"analysis.damping.rate", "analysis.damping.rate"},
      {"probe.box.min", "probe.a point.box"},
      {"probe.box.max", "probe.a point.box"},
      {"probe.point", "probe.a point.point.1"},
      {"probe.center", "probe.a point.center"},
      {"probe.percentile", "probe.worst.percentile"},
      {"output.every", "output.every"},
      {"output.history_every", "output.history_every"},
      {"output.checkpoint_every", "output.checkpoint_every"},
      {"output.checkpoint_every_wall", "output.checkpoint_every_wall"},
  };
  return places;
}

// The message about a number of the input; empty when nothing is wrong with it.
std::string message_of(const std::string& name, const std::string& number) {
  const std::filesystem::path corpus = std::filesystem::path(KOSHI_SOURCE_DIR) / "tests/fuzz/corpus/input";
  const std::string& path = places().at(name);
  std::string value = number;
  // What the case does not give by itself is given whole.
  if (path.ends_with(".point") || path.ends_with(".center")) value = fmt::format("[0, {}, 0]", number);
  if (path == "body.scan.size") value = fmt::format("[1, {}, 1]", number);
  if (path.ends_with(".thresholds") || path.ends_with(".grey") || path.ends_with(".scan.density"))
    value = fmt::format("[{}]", number);
  if (path.ends_with(".box") || path.ends_with(".crop"))
    value = name.ends_with("min") ? fmt::format("{{ min = [0, 0, {}], max = [1, 1, 1] }}", number)
                                  : fmt::format("{{ min = [0, 0, 0], max = [1, 1, {}] }}", number);
  std::vector<std::string> overrides;
  if (name == "analysis.damping.rate") overrides.emplace_back("analysis.damping.kind=viscous");
  if (name.starts_with("material.fracture."))
    overrides.emplace_back("material.soft.fracture={tensile_strength=1, fracture_energy=1, cohesion=10}");
  if (name.starts_with("material.fracture.critical"))
    overrides.emplace_back("material.soft.fracture={law='bonds', critical_stretch=1e-3}");
  if (name.ends_with("scatter.variation"))
    overrides.push_back(path.substr(0, path.rfind('.')) + ".distribution=normal");
  if (name.starts_with("crack."))
    overrides.emplace_back(
        "crack=[{center=[0, 0, 0], normal=[1, 0, 0], radius=1}, {center=[0, 0, 0], normal=[1, 0, 0], "
        "shape='rectangle', along=[0, 1, 0], length=1, width=1}]");
  if (name == "analysis.stop_when.below") overrides.emplace_back("analysis.stop_when.probe=tip");
  if (name.starts_with("macroscopic.")) overrides.emplace_back("macroscopic={history=[[0, 1], [1, 1]]}");
  if (name == "analysis.near") overrides.emplace_back("analysis={type='modes'}");
  if (name == "probe.center") overrides.emplace_back("probe.a point.quantity=moment");
  overrides.push_back(path + "=" + value);
  try {
    read_case(corpus / "stepped.toml", overrides);
  } catch (const InputError& error) {
    return error.message();
  }
  return "";
}

void expect_refused(const std::string& name, double value) {
  EXPECT_THAT(message_of(name, fmt::format("{:.17g}", value)), HasSubstr("; it must ")) << name << " = " << value;
}

void expect_within(const std::string& name, double value) {
  // Something else may be wrong with it, but not its range.
  EXPECT_EQ(message_of(name, fmt::format("{:.17g}", value)).find("; it must "), std::string::npos)
      << name << " = " << value;
}

// An open end is refused itself, a closed one is not; what lies beyond never goes through.
TEST(Ranges, EveryNumberIsKeptToThem) {
  int count = 0;
  for (const auto& [name, schema] : numbers_of_schema()) {
    ASSERT_TRUE(places().contains(name)) << name;
    const bool open_below = schema.contains("exclusiveMinimum"), open_above = schema.contains("exclusiveMaximum");
    const double least = schema.at(open_below ? "exclusiveMinimum" : "minimum");
    const double most = schema.at(open_above ? "exclusiveMaximum" : "maximum");
    EXPECT_LT(least, most) << name;
    if (open_below)
      expect_refused(name, least);
    else
      expect_within(name, least);
    if (open_above)
      expect_refused(name, most);
    else
      expect_within(name, most);
    for (const double beyond : {std::nextafter(least, -infinity), std::nextafter(most, infinity), -1e300, 1e300})
      expect_refused(name, beyond);
    if (schema.contains("smallestSize")) {
      const double smallest = schema.at("smallestSize");
      for (const double sign : {-1.0, 1.0}) {
        expect_within(name, sign * smallest);
        expect_refused(name, sign * std::nextafter(smallest, 0.0));
        expect_refused(name, sign * 1e-300);
      }
      expect_within(name, 0);
    }
    for (const char* no_number : {"nan", "-nan", "inf", "-inf"})
      EXPECT_THAT(message_of(name, no_number), HasSubstr("expected a finite number")) << name;
    EXPECT_THAT(message_of(name, "\"1e400\""), HasSubstr("is out of the range of numbers")) << name;
    ++count;
  }
  EXPECT_EQ(count, 116);
  EXPECT_EQ(places().size(), 116u);
}

// The unit of a range is the one in which the reader gives its values.
template <class S>
int check_units() {
  int count = 0;
  for (const auto& key : keys_of(Tag<S>{})) {
    const model::Range& range = key.spec.range;
    if (range.least == range.most) continue;  // no number
    EXPECT_EQ(range.unit, words(key.spec.dimension).si_unit) << key.spec.name;
    const model::Range& rotation = key.spec.rotation_range;
    if (rotation.least != rotation.most) EXPECT_EQ(rotation.unit, words(key.spec.rotation).si_unit) << key.spec.name;
    ++count;
  }
  return count;
}

TEST(Ranges, HaveTheUnitOfTheirKey) {
  using namespace model;
  EXPECT_EQ(check_units<LatticeDefinition>() + check_units<BodyDefinition>() + check_units<ScanDefinition>() +
                check_units<MaterialDefinition>() + check_units<RegionDefinition>() +
                check_units<BoundaryDefinition>() + check_units<LoadDefinition>() + check_units<AnalysisDefinition>() +
                check_units<DampingDefinition>() + check_units<ProbeDefinition>() + check_units<OutputDefinition>() +
                check_units<material::Fracture>() + check_units<material::Scatter>() +
                check_units<GrainBoundaryDefinition>() + check_units<CrackDefinition>() +
                check_units<StopDefinition>() + check_units<SelectionDefinition>() + check_units<SphereShape>() +
                check_units<CylinderShape>() + check_units<HalfSpaceShape>() + check_units<MeanStrain>() +
                check_units<MeanStress>(),
            1 + 2 + 9 + 3 + 5 + 9 + 7 + 8 + 6 + 3 + 4 + 4 + 6 + 1 + 6 + 2 + 2 + 2 + 3 + 2 + 6 + 6);
}

// A fracture with nothing wrong but what it is given.
material::Fracture& fracture_of(model::Definition& definition) {
  material::Fracture& fracture = definition.materials[0].fracture.emplace();
  fracture.law = material::FractureLaw::none;
  fracture.tensile_strength = fracture.fracture_energy = 1;
  fracture.cohesion = 10;
  return fracture;
}

material::Fracture& bonds_of(model::Definition& definition) {
  material::Fracture& fracture = definition.materials[0].fracture.emplace();
  fracture.law = material::FractureLaw::bonds;
  fracture.critical_stretch = fracture.critical_shear = 1e-3;
  return fracture;
}

material::Scatter& scatter_of(model::Definition& definition) {
  return definition.materials[0].stiffness_scatter.emplace(
      material::Scatter{.distribution = material::Distribution::normal, .variation = 0.1});
}

// A program that fills the structs itself meets the same ranges.
TEST(Ranges, HoldForDefinitionsOfAProgram) {
  using D = model::Definition;
  const std::vector<std::function<double&(D&)>> members{
      [](D& d) -> double& { return d.lattice.spacing; },
      [](D& d) -> double& { return d.body.origin[2]; },
      [](D& d) -> double& { return d.body.size[0]; },
      [](D& d) -> double& { return d.materials[0].elastic.youngs_modulus; },
      [](D& d) -> double& { return d.materials[0].elastic.poissons_ratio; },
      [](D& d) -> double& { return d.materials[0].elastic.density; },
      [](D& d) -> double& { return fracture_of(d).tensile_strength; },
      [](D& d) -> double& { return fracture_of(d).fracture_energy; },
      [](D& d) -> double& { return fracture_of(d).cohesion.emplace(); },
      [](D& d) -> double& { return fracture_of(d).friction_angle; },
      [](D& d) -> double& { return fracture_of(d).residual_friction_angle; },
      [](D& d) -> double& { return *bonds_of(d).critical_stretch; },
      [](D& d) -> double& { return *bonds_of(d).critical_shear; },
      [](D& d) -> double& { return fracture_of(d).strength_scatter.emplace().modulus; },
      [](D& d) -> double& { return scatter_of(d).variation; },
      [](D& d) -> double& { return scatter_of(d).correlation_length; },
      [](D& d) -> double& { return d.body.grain_boundary.emplace().strength.emplace(); },
      [](D& d) -> double& { return d.regions[0].min[0]; },
      [](D& d) -> double& { return d.regions[0].max[1]; },
      [](D& d) -> double& { return d.regions[1].center[2]; },
      [](D& d) -> double& { return d.regions[1].radius; },
      [](D& d) -> double& { return d.regions[2].start[0]; },
      [](D& d) -> double& { return d.regions[2].end[0]; },
      [](D& d) -> double& { return d.regions[2].radius; },
      [](D& d) -> double& { return d.regions[3].point[1]; },
      [](D& d) -> double& { return d.regions[3].normal[1]; },
      [](D& d) -> double& { return d.regions[4].scale; },
      [](D& d) -> double& { return d.boundaries[1].displacement[0].emplace(); },
      [](D& d) -> double& { return d.boundaries[1].displacement[5].emplace(); },
      [](D& d) -> double& { return d.boundaries[1].velocity[2].emplace(); },
      [](D& d) -> double& { return d.boundaries[1].velocity[4].emplace(); },
      [](D& d) -> double& { return d.boundaries[1].ramp; },
      [](D& d) -> double& { return d.boundaries[1].history[2][0]; },
      [](D& d) -> double& { return d.boundaries[1].history[1][1]; },
      [](D& d) -> double& { return d.boundaries[2].selection.box->first[0]; },
      [](D& d) -> double& { return d.boundaries[2].selection.box->second[0]; },
      [](D& d) -> double& { return d.boundaries[2].twist[2].emplace(); },
      [](D& d) -> double& { return d.boundaries[2].center.emplace()[0]; },
      [](D& d) -> double& { return d.loads[0].force.emplace()[0]; },
      [](D& d) -> double& { return d.loads[1].traction.emplace()[0]; },
      [](D& d) -> double& { return d.loads[2].pressure.emplace(); },
      [](D& d) -> double& { return d.loads[3].acceleration.emplace()[0]; },
      [](D& d) -> double& { return d.analysis.tolerance; },
      [](D& d) -> double& { return d.analysis.duration.emplace(); },
      [](D& d) -> double& { return d.analysis.time_step.emplace(); },
      [](D& d) -> double& { return d.analysis.safety; },
      [](D& d) -> double& { return d.analysis.damping.factor; },
      [](D& d) -> double& { return d.analysis.damping.rate; },
      [](D& d) -> double& { return d.probes[0].selection.point.emplace()[0]; },
      [](D& d) -> double& { return d.probes[1].percentile; },
      [](D& d) -> double& { return d.output.every.emplace(); },
      [](D& d) -> double& { return d.output.history_every.emplace(); },
      [](D& d) -> double& { return d.output.checkpoint_every.emplace(); },
      [](D& d) -> double& { return d.output.checkpoint_wall.emplace(); },
  };
  const D right = read_case(std::filesystem::path(KOSHI_SOURCE_DIR) / "tests/fuzz/corpus/input/stepped.toml");
  ASSERT_NO_THROW(model::check(right));
  int count = 0;
  for (std::size_t m = 0; m < members.size(); ++m)
    for (const double value : {-1e300, 1e300, infinity, -infinity, std::nan("")}) {
      D wrong = right;
      members[m](wrong) = value;
      EXPECT_THROW(model::check(wrong), InputError) << "member " << m << " = " << value;
      ++count;
    }
  EXPECT_EQ(count, 54 * 5);
}

}  // namespace
}  // namespace koshi::io
