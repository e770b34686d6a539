// Overrides "section.key=value", and how the reader meets files.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "support/broken_input.h"

namespace koshi::tests {
namespace {

model::Definition read(const std::vector<std::string>& overrides) {
  return io::read_case_text(right_case, "case.toml", overrides);
}

std::string message(const std::string& override_text) {
  const std::vector<std::string> overrides{override_text};
  return message_of(right_case, overrides);
}

TEST(Overrides, ValuesAreTomlOrBareText) {
  EXPECT_EQ(read({"lattice.spacing=0.1 cm"}).lattice.spacing, 0.001);
  EXPECT_EQ(read({"lattice.spacing=\"0.1 cm\""}).lattice.spacing, 0.001);
  EXPECT_EQ(read({"lattice.spacing=0.001"}).lattice.spacing, 0.001);
  EXPECT_EQ(read({"lattice.cell=cube-I"}).lattice.cell, lattice::CellType::cube_i);
  EXPECT_EQ(read({"body.size=[0.004, \"2 mm\", 0.002]"}).body.size, (Vec3{0.004, 0.002, 0.002}));
  EXPECT_TRUE(read({"output.report=true"}).output.report);
  EXPECT_EQ(read({"title=a = b"}).title, "a = b");
  // Later ones win.
  EXPECT_EQ(read({"lattice.spacing=1 mm", "lattice.spacing=0.5 mm"}).lattice.spacing, 0.0005);
}

TEST(Overrides, NamesMayBeQuotedEitherWay) {
  for (const std::string quote : {"'", "\"", ""}) {
    const std::string name = quote + "top platen" + quote;
    EXPECT_EQ(read({"boundary.top.name=top platen", "boundary." + name + ".displacement.z=1 mm"})
                  .boundaries[1]
                  .displacement[2],
              0.001)
        << name;
  }
  EXPECT_EQ(read({"boundary.top.name=a.b = c", "boundary.'a.b = c'.displacement.z=1 mm"}).boundaries[1].displacement[2],
            0.001);
  EXPECT_EQ(read({"boundary.top.name=Ann's \"own\"", "boundary.Ann's \"own\".displacement.z=1 mm"})
                .boundaries[1]
                .displacement[2],
            0.001);
}

TEST(Overrides, TablesOfAListGoByNameOrIndex) {
  EXPECT_EQ(read({"boundary.top.displacement.z=1 mm"}).boundaries[1].displacement[2], 0.001);
  EXPECT_EQ(read({"boundary.1.displacement.z=1 mm"}).boundaries[1].displacement[2], 0.001);
  EXPECT_EQ(read({"load.push.force.2=3 N"}).loads[0].force, (Vec3{1, 0, 3}));
  EXPECT_EQ(read({"probe.0.quantity=stress"}).probes[0].quantity, model::ProbeDefinition::Quantity::stress);
  EXPECT_EQ(read({"probe.0.name=a.b", "probe.\"a.b\".reduce=max"}).probes[0].reduce,
            model::ProbeDefinition::Reduce::max);
}

TEST(Overrides, MakeWhatIsNotThere) {
  const auto definition = read({"material.sand.youngs_modulus=1 MPa", "material.sand.poissons_ratio=0.2",
                                "material.sand.density=1600", "output.fields=[\"stress\"]"});
  ASSERT_EQ(definition.materials.size(), 2u);
  EXPECT_EQ(definition.materials[1].name, "sand");
  EXPECT_EQ(definition.materials[1].elastic.youngs_modulus, 1e6);
  EXPECT_EQ(definition.output.fields, std::vector<std::string>{"stress"});
}

// A key of the file that an override leaves without meaning is set aside; one of the overrides is not.
TEST(Overrides, ChangingTheKindSetsKeysOfTheFileAside) {
  EXPECT_EQ(read({"analysis.type=static"}).analysis.type, model::AnalysisDefinition::Type::statics);
  EXPECT_EQ(read({"analysis.damping.kind=none"}).analysis.damping.kind, model::DampingDefinition::Kind::none);
  const auto body = read({"body.image=a.npy", "body.materials={ 1 = \"rock\" }"}).body;
  EXPECT_EQ(body.image, "a.npy");
  EXPECT_EQ(body.size, Vec3{});
  EXPECT_EQ(message_of(right_case, std::vector<std::string>{"analysis.type=static", "analysis.safety=0.5"}),
            "--set analysis.safety=0.5: error: \"safety\" has no meaning here; it goes with type \"quasi-static\" or "
            "\"dynamic\"");
}

TEST(Overrides, ErrorsNameTheOverride) {
  EXPECT_EQ(
      message("lattice.spacing=0.3 cm"),
      "case.toml:6:9: error: size along x is 0.008 m, no positive multiple of the spacing 0.003 m; the nearest right "
      "sizes: 0.006 m, 0.009 m");
  EXPECT_EQ(message("lattice.spacing=-1"),
            "--set lattice.spacing=-1: error: spacing is -1 m; it must lie between 1e-12 m and 1e+09 m");
  EXPECT_EQ(message("lattice.spacin=1 mm"),
            "--set lattice.spacin=1 mm: error: unknown key \"spacin\" in [lattice]; did you mean \"spacing\"?");
  EXPECT_EQ(message("latice.spacing=1 mm"),
            "--set latice.spacing=1 mm: error: unknown key \"latice\" in the input; did you mean \"lattice\"?");
  EXPECT_EQ(
      message("body.size=[0, 1"),
      "--set body.size=[0, 1: error: size is the text \"[0, 1\"; expected a list of three (x, y, z), each a length "
      "such as \"0.2 cm\" (a bare number is in m)");
  EXPECT_EQ(message("body.size=[1, 2, -3]"),
            "--set body.size=[1, 2, -3]: error: size[2] is -3 m; it must lie between 1e-12 m and 1e+12 m");
  EXPECT_EQ(message("title=1\nname=2"), "");  // not two keys, but one text
  const std::string form = ": error: not an assignment; expected section.key=value such as lattice.spacing=\"0.1 cm\"";
  for (const char* text : {"", "=", "=1", "lattice.spacing", "lattice.=1", ".spacing=1", "lattice..spacing=1"})
    EXPECT_EQ(message(text), "--set " + std::string(text) + form);
  EXPECT_EQ(
      message("boundary.tap.fix=[\"x\"]"),
      "--set boundary.tap.fix=[\"x\"]: error: \"boundary\" has no element \"tap\"; give an index from 0 to 1 or a "
      "name; did you mean \"top\"?");
  EXPECT_EQ(message("boundary.2.fix=[\"x\"]"),
            "--set boundary.2.fix=[\"x\"]: error: \"boundary\" has no element \"2\"; give an index from 0 to 1 or a "
            "name; known: \"bottom\", \"top\"");
  EXPECT_EQ(message("load.push.force.3=1"),
            "--set load.push.force.3=1: error: \"load.push.force\" has no element \"3\"; give an index from 0 to 2");
  EXPECT_EQ(message("lattice.cell.x=1"),
            "--set lattice.cell.x=1: error: \"lattice.cell\" is the text \"cube-III\"; it has no \"x\" in it");
}

TEST(Places, PointAtKeysTablesAndElements) {
  const auto definition = read({"lattice.kinematics=rotational"});
  const auto place = [&](const std::string& path) {
    const Place found = definition.places.find(path);
    return found.file + ":" + std::to_string(found.line) + ":" + std::to_string(found.column);
  };
  EXPECT_EQ(place("lattice.spacing"), "case.toml:4:11");
  EXPECT_EQ(place("body.size[2]"), "case.toml:6:29");
  EXPECT_EQ(place("boundary[1]"), "case.toml:21:1");
  EXPECT_EQ(place("boundary[1].displacement.z"), "case.toml:24:22");
  EXPECT_EQ(place("boundary[1].ramp"), "case.toml:21:1");  // not given: its table
  EXPECT_EQ(place("material.rock.density"), "case.toml:11:11");
  EXPECT_EQ(place("lattice.kinematics"), "--set lattice.kinematics=rotational:0:0");
  EXPECT_EQ(place("nowhere"), "case.toml:1:1");
}

// A definition made in code has no places: the path of the key stands for it.
TEST(Check, NamesThePathWithoutAPlace) {
  auto definition = read({});
  definition.places = {};
  definition.materials[0].elastic.density = std::numeric_limits<double>::quiet_NaN();
  try {
    check(definition);
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_STREQ(
        error.what(),
        "material.rock.density: error: density is nan kg/m^3; it must lie between 1e-09 kg/m^3 and 1e+18 kg/m^3");
  }
}

TEST(ReadCase, FilesThatCannotBeRead) {
  const auto message_of_file = [](const std::filesystem::path& file) -> std::string {
    try {
      io::read_case(file);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message_of_file("/nowhere/case.toml"),
            "/nowhere/case.toml: error: cannot be opened (No such file or directory); expected a case file in TOML");
  EXPECT_EQ(message_of_file("/"), "/: error: is a folder; expected a case file in TOML");
  EXPECT_EQ(message_of_file("/dev/zero"), "/dev/zero: error: is larger than 16 MiB; expected a case file in TOML");
}

TEST(ReadCase, ByteOrderMarkAndCarriageReturns) {
  std::string text = "\xef\xbb\xbf";
  for (const char c : right_case) text += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_TRUE(io::read_case_text(text, "case.toml") == read({}));
}

}  // namespace
}  // namespace koshi::tests
