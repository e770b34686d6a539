// The resolved input and the schema: written from the same table of keys that reads.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "koshi/input.h"
#include "support/broken_input.h"

namespace koshi::io {
namespace {

using Json = nlohmann::json;

std::string contents(const std::filesystem::path& path) {
  std::stringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

// The examples, and two cases that hold every key between them.
std::vector<std::filesystem::path> right_cases() {
  const std::filesystem::path source(KOSHI_SOURCE_DIR);
  return {source / "examples/01_uniaxial_paper/case.toml",   source / "examples/02_cantilever_paper/case.toml",
          source / "examples/03_cantilever_exact/case.toml", source / "examples/04_two_phase_block/case.toml",
          source / "tests/fuzz/corpus/input/stepped.toml",   source / "tests/fuzz/corpus/input/image.toml"};
}

TEST(ResolvedInput, ReadsBackEqual) {
  for (const auto& path : right_cases()) {
    const model::Definition definition = read_case(path);
    const std::string resolved = resolved_toml(definition);
    const model::Definition again = read_case_text(resolved, "resolved.toml");
    EXPECT_TRUE(again == definition) << resolved;
    EXPECT_EQ(resolved_toml(again), resolved);
  }
}

// Equality must see a change of any member, or the test above shows nothing: each override makes a definition differ,
// and the difference survives the way through the resolved input.
TEST(ResolvedInput, EveryKeySurvives) {
  const auto expect_survival = [](const std::filesystem::path& path, const std::string& change) {
    const std::vector<std::string> overrides{change};
    const model::Definition after = read_case(path, overrides);
    EXPECT_FALSE(after == read_case(path)) << change;
    EXPECT_TRUE(read_case_text(resolved_toml(after), "resolved.toml") == after) << change;
  };
  const std::vector<std::string> changes{"title=other",
                                         "lattice.cell=cube-III",
                                         "lattice.spacing=0.5 mm",
                                         "lattice.springs=shared",
                                         "lattice.calibration=isotropic",

                                         "lattice.equations=[\"C1122\", \"C1111\"]",
                                         "lattice.axes=xyz",
                                         "body.origin.1=0.25",
                                         "body.size=[\"6 mm\", \"5 mm\", \"6 mm\"]",
                                         "body.material=soft",
                                         "body.periodic=[false, false, true]",
                                         "material.soft.youngs_modulus=2",
                                         "material.soft.poissons_ratio=0.25",
                                         "material.soft.density=1",
                                         "region.0.min=[\"0.1 mm\", 0, 0]",
                                         "region.0.max=[1, 1, 1]",
                                         "region.0.material=void",
                                         "region.1.center=[0, 0, 0]",
                                         "region.1.radius=1",
                                         "region.2.start=[1, 0, 0]",
                                         "region.2.end=[1, 0, 0]",
                                         "region.3.point=[1, 0, 0]",
                                         "region.3.normal=[1, 0, 0]",
                                         "region.4.file=/b.stl",
                                         "region.4.scale=2",
                                         "boundary.held.name=x",
                                         "boundary.held.face=x-max",
                                         "boundary.held.fix=[\"x\"]",
                                         "boundary.1.displacement.x=1",
                                         "boundary.1.velocity.z=1",
                                         "boundary.1.ramp=2",
                                         "boundary.1.history=[[0, 1]]",
                                         "boundary.turned.twist.z=1",
                                         "boundary.turned.center=[0, 0, 0]",
                                         "boundary.turned.box={ min = [0, 0, 0], max = [1, 1, 1] }",
                                         "load.0.force=[1, 1, 1]",
                                         "load.0.distribution=area",
                                         "load.0.history=[[0, 1]]",
                                         "load.wind.traction=[1, 1, 1]",
                                         "load.water.pressure=1",
                                         "load.weight.acceleration=[1, 1, 1]",
                                         "load.water.name=x",
                                         "load.wind.face=x-min",
                                         "analysis.tolerance=0.5",
                                         "analysis.duration=1",
                                         "analysis.time_step=1",
                                         "analysis.time_step=auto",
                                         "analysis.allow_unstable_step=false",
                                         "analysis.safety=0.25",
                                         "analysis.damping.factor=0.5",
                                         "analysis.damping.kind=none",
                                         "analysis.start_from=/a",
                                         "probe.a point.name=x",
                                         "probe.0.point=[1, 1, 1]",
                                         "probe.0.quantity=stress",
                                         "probe.0.reduce=sum",
                                         "output.fields=[]",
                                         "output.every=2",
                                         "output.history_every=2",
                                         "output.checkpoint_every=2",
                                         "output.checkpoint_every_wall=2",
                                         "output.report=false"};
  for (const std::string& change : changes) expect_survival(right_cases()[4], change);
  expect_survival(right_cases()[0], "lattice.kinematics=least-squares");
  expect_survival(right_cases()[0], "analysis.type=quasi-static");
  expect_survival(right_cases()[5], "body.image=/b.npy");
  expect_survival(right_cases()[5], "body.materials.-7=void");
  expect_survival(right_cases()[5], "analysis.damping.rate=3");
}

TEST(ResolvedInput, WritesDefaultsInSI) {
  const std::string resolved = resolved_toml(read_case(right_cases()[2]));
  for (const char* line :
       {"spacing = 0.002\n", "springs = \"shared\"\n", "origin = [0.0, 0.0, 0.0]\n",
        "periodic = [false, false, false]\n", "youngs_modulus = 1112000000.0\n", "size = [0.018, 0.078, 0.018]\n",
        "force = [9.8, 0.0, 0.0]\n", "fields = [\"displacement\"]\n", "report = false\n", "tolerance = 1e-10\n"})
    EXPECT_NE(resolved.find(line), std::string::npos) << line << resolved;
}

// The resolved input may be read from elsewhere: relative files start from the case's own directory.
TEST(ResolvedInput, FilesBecomeAbsolute) {
  const std::vector<std::string> overrides{"region.4.file=part.stl", "analysis.start_from=../before"};
  const std::string text = contents(right_cases()[4]);
  const std::string resolved = resolved_toml(read_case_text(text, "/cases/here/case.toml", overrides));
  EXPECT_NE(resolved.find("file = \"/cases/here/part.stl\""), std::string::npos) << resolved;
  EXPECT_NE(resolved.find("start_from = \"/cases/before\""), std::string::npos) << resolved;
}

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
  result["damping"] = keys(schema.at("properties").at("analysis").at("properties").at("damping"));
  return result;
}

// The reader names the keys it knows when it meets one that resembles none.
std::set<std::string> known_keys(const std::string& override_path) {
  const std::vector<std::string> overrides{override_path + "qqqqqqqqqq=1"};
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
      {"material", "material.rock."},
      {"region", "region.0."},
      {"boundary", "boundary.top."},
      {"load", "load.push."},
      {"analysis", "analysis."},
      {"damping", "analysis.damping."},
      {"probe", "probe.tip."},
      {"output", "output."},
  };
  ASSERT_EQ(schema.size(), paths.size());
  std::size_t count = 0;
  for (const auto& [table, path] : paths) {
    EXPECT_EQ(schema.at(table), known_keys(path)) << table;
    count += schema.at(table).size();
  }
  EXPECT_EQ(count, 10u + 7 + 6 + 3 + 12 + 11 + 10 + 8 + 3 + 6 + 6);
}

TEST(Schema, TellsTypeDefaultAndMeaning) {
  const Json schema = Json::parse(schema_json());
  const Json& lattice = schema.at("properties").at("lattice");
  EXPECT_EQ(lattice.at("required"), Json({"spacing"}));
  EXPECT_EQ(lattice.at("additionalProperties"), false);
  EXPECT_EQ(lattice.at("properties").at("spacing"),
            Json::parse(R"({"type": ["number", "string"], "unit": "m", "description": "Side d of a cell."})"));
  EXPECT_EQ(lattice.at("properties").at("springs"), Json::parse(R"({"enum": ["shared", "plain"], "default": "shared",
      "description": "Springs belong to cells (shared), or every bond carries its full stiffness."})"));
  const Json& boundary = schema.at("properties").at("boundary").at("items").at("properties");
  EXPECT_EQ(boundary.at("displacement").at("properties").at("z").at("unit"), "m");
  EXPECT_EQ(boundary.at("displacement").at("properties").at("rz").at("unit"), "rad");
  EXPECT_EQ(boundary.at("velocity").at("properties").at("rz").at("unit"), "rad/s");
  EXPECT_EQ(boundary.at("fix"), Json::parse(R"({"type": "array", "items": {"enum": ["x", "y", "z", "rx", "ry", "rz"]},
      "uniqueItems": true, "description":
      "Components held at zero; rotations count only with rotational kinematics."})"));
  const Json& analysis = schema.at("properties").at("analysis").at("properties");
  EXPECT_EQ(analysis.at("time_step").at("default"), "auto");
  EXPECT_EQ(analysis.at("damping").at("default"), Json::parse(R"({"kind": "local", "factor": 0.8})"));
  EXPECT_EQ(analysis.at("damping").at("properties").at("rate").at("description"),
            "Damping force over mass times velocity. Only for kind \"viscous\".");
  EXPECT_EQ(schema.at("properties").at("output").at("properties").at("fields").at("default"), Json({"displacement"}));
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
  EXPECT_EQ(described, 7 + 6 + 12 + 11 + 10 + 8 + 6 + 6);
}

}  // namespace
}  // namespace koshi::io
