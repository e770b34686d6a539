// The schema of the input: made from the same table of keys that reads, and true to it.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "io/toml/key.h"
#include "koshi/input.h"
#include "support/broken_input.h"

namespace koshi::io {
namespace {

// Equal whatever the order of the keys, unlike the writer's.
using Json = nlohmann::json;

// Keys of the schema by table, "" for the top.
std::map<std::string, std::set<std::string>> schema_keys() {
  const Json schema = Json::parse(schema_json());
  const auto keys = [](const Json& table) {
    std::set<std::string> names;
    for (const auto& [name, key] : table.at("properties").items()) names.insert(name);
    return names;
  };
  std::map<std::string, std::set<std::string>> result;
  result[""] = keys(schema);
  for (const auto& [name, table] : schema.at("properties").items()) {
    if (table.contains("items")) result[name] = keys(table.at("items"));
    if (table.contains("properties")) result[name] = keys(table);
    if (name == "material") result[name] = keys(table.at("additionalProperties"));
  }
  const Json& body = schema.at("properties").at("body").at("properties");
  const Json& material = schema.at("properties").at("material").at("additionalProperties").at("properties");
  result["fracture"] = keys(material.at("fracture"));
  result["grain_boundary"] = keys(body.at("grain_boundary"));
  result["stiffness_scatter"] = keys(material.at("stiffness_scatter"));
  result["strength_scatter"] = keys(material.at("fracture").at("properties").at("strength_scatter"));
  result["scan"] = keys(body.at("scan"));
  result["stop_when"] = keys(schema.at("properties").at("analysis").at("properties").at("stop_when"));
  const Json& macroscopic = schema.at("properties").at("macroscopic").at("properties");
  result["mean_strain"] = keys(macroscopic.at("strain"));
  result["mean_stress"] = keys(macroscopic.at("stress"));
  result["damping"] = keys(schema.at("properties").at("analysis").at("properties").at("damping"));
  return result;
}

// The reader names the keys it knows when it meets one that resembles none.
std::set<std::string> known_keys(const std::string& override_path) {
  std::vector<std::string> overrides;
  if (override_path.starts_with("crack")) overrides.emplace_back("crack=[{center=[0, 0, 0], normal=[1, 0, 0]}]");
  if (override_path.find("fracture.") != std::string::npos)
    overrides.emplace_back("material.rock.fracture={tensile_strength=1, fracture_energy=1}");
  overrides.push_back(override_path + "qqqqqqqqqq=1");
  const std::string message = tests::message_of(tests::right_case, overrides);
  std::set<std::string> names;
  std::size_t at = message.find("known: ");
  EXPECT_NE(at, std::string::npos) << message;
  while ((at = message.find('"', at)) != std::string::npos) {
    const std::size_t end = message.find('"', at + 1);
    names.insert(message.substr(at + 1, end - at - 1));
    at = end + 1;
  }
  return names;
}

TEST(Schema, ListsTheKeysOfTheReader) {
  const auto schema = schema_keys();
  const std::map<std::string, std::string> paths{
      {"", ""},
      {"lattice", "lattice."},
      {"body", "body."},
      {"scan", "body.scan."},
      {"material", "material.rock."},
      {"fracture", "material.rock.fracture."},
      {"strength_scatter", "material.rock.fracture.strength_scatter."},
      {"stiffness_scatter", "material.rock.stiffness_scatter."},
      {"grain_boundary", "body.grain_boundary."},
      {"region", "region.0."},
      {"selection", "selection.spot."},
      {"boundary", "boundary.top."},
      {"load", "load.push."},
      {"analysis", "analysis."},
      {"damping", "analysis.damping."},
      {"stop_when", "analysis.stop_when."},
      {"macroscopic", "macroscopic."},
      {"mean_strain", "macroscopic.strain."},
      {"mean_stress", "macroscopic.stress."},
      {"crack", "crack.0."},
      {"probe", "probe.tip."},
      {"output", "output."},
  };
  ASSERT_EQ(schema.size(), paths.size());
  std::size_t count = 0;
  for (const auto& [table, path] : paths) {
    EXPECT_EQ(schema.at(table), known_keys(path)) << table;
    count += schema.at(table).size();
  }
  EXPECT_EQ(count, 13u + 3 + 6 + 6 + 7 + 11 + 12 + 5 + 10 + 5 + 5 + 3 + 13 + 11 + 14 + 13 + 14 + 4 + 10 + 3 + 9 + 9);
}

TEST(Schema, TellsTypeDefaultAndMeaning) {
  const Json schema = Json::parse(schema_json());
  const Json& lattice = schema.at("properties").at("lattice");
  EXPECT_EQ(lattice.at("required"), Json({"spacing"}));
  EXPECT_EQ(lattice.at("additionalProperties"), false);
  EXPECT_EQ(lattice.at("properties").at("spacing"),
            Json::parse(
                R"({"type": ["number", "string"], "unit": "m", "minimum": 1e-12, "maximum": 1e9, "examples": ["0.2 cm"],
      "description": "Side d of a cell; \"image\": of the voxels of the image, in its body.scan.unit."})"));
  EXPECT_EQ(lattice.at("properties").at("springs"), Json::parse(R"({"enum": ["shared", "plain"], "default": "shared",
      "description": "Springs belong to cells (shared), or every bond carries its full stiffness."})"));
  const Json& boundary = schema.at("properties").at("boundary").at("items").at("properties");
  EXPECT_EQ(boundary.at("displacement").at("properties").at("z").at("unit"), "m");
  EXPECT_EQ(boundary.at("displacement").at("properties").at("rz").at("unit"), "rad");
  EXPECT_EQ(boundary.at("velocity").at("properties").at("rz").at("unit"), "rad/s");
  EXPECT_EQ(boundary.at("fix"), Json::parse(R"({"type": "array", "items": {"enum": ["x", "y", "z", "rx", "ry", "rz"]},
      "uniqueItems": true, "examples": [["x", "y", "z", "rx", "ry", "rz"]], "description":
      "Components held at zero; rotations count only with rotational kinematics."})"));
  const Json& analysis = schema.at("properties").at("analysis").at("properties");
  EXPECT_EQ(analysis.at("time_step").at("default"), "auto");
  EXPECT_EQ(analysis.at("damping").at("default"), Json::parse(R"({"kind": "local", "factor": 0.8})"));
  EXPECT_EQ(analysis.at("damping").at("properties").at("rate").at("description"),
            "Damping force over mass times velocity. Only for kind \"viscous\".");
  EXPECT_EQ(analysis.at("damping").at("properties").at("rate").at("requiredWhereItApplies"), true);
  EXPECT_EQ(schema.at("properties").at("output").at("properties").at("fields").at("default"), Json({"displacement"}));
  const Json& fracture =
      schema.at("properties").at("material").at("additionalProperties").at("properties").at("fracture");
  EXPECT_EQ(fracture.at("properties").at("tensile_strength").at("requiredWhereItApplies"), true);
  EXPECT_EQ(fracture.at("properties").at("critical_stretch").at("description"),
            "Stretch at which a bond breaks, of its length; unset: from fracture_energy. Only for law \"bonds\" "
            "or \"none\".");
  EXPECT_EQ(fracture.at("properties").at("fracture_energy").at("unit"), "J/m^2");
  // Every key is described by one sentence.
  int described = 0;
  for (const auto& [name, table] : schema.at("properties").items()) {
    const Json& keys = table.contains("items") ? table.at("items") : table;
    if (!keys.contains("properties")) continue;
    for (const auto& [key, value] : keys.at("properties").items()) {
      const std::string description = value.at("description");
      EXPECT_GT(description.size(), 5u) << key;
      EXPECT_EQ(description.back(), '.') << key;
      ++described;
    }
  }
  EXPECT_EQ(described, 7 + 11 + 12 + 9 + 11 + 14 + 13 + 14 + 11 + 9 + 3);
}

// The example of each key is what its reader takes, and sets something.
template <class S>
int read_examples() {
  int count = 0;
  for (const auto& key : keys_of(Tag<S>{})) {
    if (key.example.empty()) continue;
    const Value value = parse_toml("value = " + key.example, "example").table()->front().value;
    S s;
    EXPECT_NO_THROW(key.read(value, key.spec, s)) << key.spec.name << " = " << key.example;
    EXPECT_FALSE(key.write(s, key.spec).empty()) << key.spec.name;
    ++count;
  }
  return count;
}

TEST(Schema, ExamplesAreRight) {
  using namespace model;
  const int count =
      read_examples<Definition>() + read_examples<LatticeDefinition>() + read_examples<BodyDefinition>() +
      read_examples<ScanDefinition>() + read_examples<MaterialDefinition>() + read_examples<RegionDefinition>() +
      read_examples<BoundaryDefinition>() + read_examples<LoadDefinition>() + read_examples<AnalysisDefinition>() +
      read_examples<DampingDefinition>() + read_examples<ProbeDefinition>() + read_examples<OutputDefinition>() +
      read_examples<material::Fracture>() + read_examples<material::Scatter>() +
      read_examples<GrainBoundaryDefinition>() + read_examples<CrackDefinition>() + read_examples<StopDefinition>() +
      read_examples<SelectionDefinition>() + read_examples<SphereShape>() + read_examples<CylinderShape>() +
      read_examples<HalfSpaceShape>();
  EXPECT_EQ(count, 1 + 3 + 10 + 10 + 5 + 7 + 13 + 13 + 9 + 10 + 1 + 7 + 7 + 4 + 3 + 7 + 4 + 10 + 2 + 3 + 2);
}

// A key without a list of words, a switch or a nested table shows an example.
TEST(Schema, EveryValueHasAnExample) {
  const Json schema = Json::parse(schema_json());
  int count = 0;
  for (const auto& [name, table] : schema.at("properties").items()) {
    const Json& nested = name == "material" ? table.at("additionalProperties") : table;
    const Json& keys = nested.contains("items") ? nested.at("items") : nested;
    if (!keys.contains("properties")) continue;
    for (const auto& [key, value] : keys.at("properties").items()) {
      if (value.contains("enum") || value.value("type", Json()) == "boolean") continue;
      EXPECT_TRUE(value.contains("examples")) << name << '.' << key;
      ++count;
    }
  }
  EXPECT_EQ(count, 3 + 10 + 5 + 11 + 8 + 12 + 12 + 11 + 5 + 7 + 11 + 3);
}

// Of some keys exactly one must be given: the schema says so, and the check refuses two of them, and none.
TEST(Schema, GroupsAreThoseOfTheCheck) {
  const Json schema = Json::parse(schema_json());
  const auto groups = [&](const std::string& table) {
    std::vector<std::vector<std::string>> result;
    for (const Json& group : schema.at("properties").at(table).at("items").at("allOf")) {
      result.emplace_back();
      for (const Json& key : group.at("oneOf")) result.back().push_back(key.at("required").at(0));
    }
    return result;
  };
  using Groups = std::vector<std::vector<std::string>>;
  EXPECT_EQ(groups("boundary"), (Groups{{"face", "box", "point", "surface", "selection"}}));
  EXPECT_EQ(groups("probe"), (Groups{{"face", "box", "point", "surface", "selection"}}));
  EXPECT_EQ(groups("load"), (Groups{{"face", "box", "point", "surface", "selection", "acceleration"},
                                    {"force", "traction", "pressure", "acceleration"}}));

  const std::map<std::string, std::string> values{{"face", "x-max"},
                                                  {"box", "{min = [0, 0, 0], max = [1, 1, 1]}"},
                                                  {"point", "[0, 0, 0]"},
                                                  {"surface", "wall"},
                                                  {"selection", "spot"},
                                                  {"force", "[1, 0, 0]"},
                                                  {"traction", "[1, 0, 0]"},
                                                  {"pressure", "1"},
                                                  {"acceleration", "[1, 0, 0]"}};
  int count = 0;
  for (const std::string table : {"boundary.bottom", "load.push", "probe.tip"})
    for (const auto& group : groups(table.substr(0, table.find('.'))))
      for (const std::string& first : group)
        for (const std::string& second : group) {
          if (first == second) continue;
          const std::vector<std::string> overrides{fmt::format("{}.{}={}", table, first, values.at(first)),
                                                   fmt::format("{}.{}={}", table, second, values.at(second))};
          EXPECT_NE(tests::message_of(tests::right_case, overrides), "") << overrides[0] << ' ' << overrides[1];
          ++count;
        }
  EXPECT_EQ(count, 20 + 30 + 12 + 20);
}

}  // namespace
}  // namespace koshi::io
