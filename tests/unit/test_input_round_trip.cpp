// The resolved input: written from the same table of keys that reads.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "koshi/input.h"
#include "support/broken_input.h"

namespace koshi::io {
namespace {

std::string contents(const std::filesystem::path& path) {
  std::stringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

// The examples, and four cases that hold every key between them.
std::vector<std::filesystem::path> right_cases() {
  const std::filesystem::path source(KOSHI_SOURCE_DIR);
  return {source / "examples/01_uniaxial_paper/case.toml",   source / "examples/02_cantilever_paper/case.toml",
          source / "examples/03_cantilever_exact/case.toml", source / "examples/04_two_phase_block/case.toml",
          source / "tests/fuzz/corpus/input/stepped.toml",   source / "tests/fuzz/corpus/input/image.toml",
          source / "tests/fuzz/corpus/input/cracked.toml",   source / "tests/fuzz/corpus/input/strained.toml",
          source / "tests/fuzz/corpus/input/bonds.toml"};
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
                                         "body.periodic=[\"z\"]",
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
                                         "region.4.name=part",
                                         "selection.ball.sphere.radius=2",
                                         "selection.bar.cylinder.radius=2",
                                         "selection.half.half_space.normal=[1, 0, 0]",
                                         "selection.end.face=x-min",
                                         "selection.any.union=[\"all\"]",
                                         "selection.both.intersection=[\"all\"]",
                                         "selection.rest.difference=[\"bar\", \"all\"]",
                                         "load.ice.selection=ball",
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
                                         "load.water.profile=x",
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
                                         "probe.worst.percentile=5",
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
  for (const char* change : {"body.scan.crop={ min = [0, 0, 1], max = [9, 9, 9] }", "body.scan.axes=['z', '-y', 'x']",
                             "body.scan.coarsen=3", "body.scan.thresholds=[1, 2.5]"})
    expect_survival(right_cases()[5], change);
  expect_survival(right_cases()[5], "analysis.damping.rate=3");
  const std::string fracture = "material.rock.fracture.", scatter = fracture + "strength_scatter.";
  for (const std::string& change : {fracture + "tensile_strength=1",
                                    fracture + "fracture_energy=1",
                                    fracture + "softening=exponential",
                                    fracture + "cohesion=1e9",
                                    fracture + "friction_angle=0",
                                    fracture + "residual_friction_angle=0",
                                    scatter + "modulus=3",
                                    scatter + "correlation_length=0",
                                    scatter + "seed=9",
                                    fracture + "strength_scatter={distribution='normal', variation=0.2}",
                                    std::string("material.rock.stiffness_scatter.variation=0.2"),
                                    std::string("body.factor=/a.npy"),
                                    std::string("body.strength=/a.npy"),
                                    std::string("body.grain_boundary.labels=/a.npy"),
                                    std::string("body.grain_boundary.strength=2"),
                                    std::string("body.grain_boundary={material='rock'}"),
                                    std::string("crack.flaw.name=x"),
                                    std::string("crack.0.center=[0, 0, 0]"),
                                    std::string("crack.0.normal=[1, 0, 0]"),
                                    std::string("crack.0.radius=1"),
                                    std::string("crack.1.along=[0, 0, 1]"),
                                    std::string("crack.1.length=1"),
                                    std::string("crack.1.width=1"),
                                    std::string("analysis.stop_when.below=0.5"),
                                    std::string("analysis.stop_when.face=y-max"),
                                    std::string("analysis.stop_when.after=0"),
                                    std::string("analysis.stop_when={face='x-max'}"),
                                    std::string("output.crack_surface=false"),
                                    std::string("output.fields=['damage']")})
    expect_survival(right_cases()[6], change);
  for (const char* change : {"critical_stretch=1", "critical_shear=1", "strength_scatter.modulus=3"})
    expect_survival(right_cases()[8], fracture + change);
  expect_survival(right_cases()[8], "material.rock.fracture={law='bonds', fracture_energy=1}");
  expect_survival(right_cases()[0], "body.surface=cut");
  for (const char* change : {"macroscopic.strain.xx=2e-3", "macroscopic.strain.yz=1", "macroscopic.strain.zz=0",
                             "macroscopic.strain.xz=1e-9", "macroscopic.stress.yy=0", "macroscopic.stress.zz=1",
                             "macroscopic.stress.xz=1", "macroscopic.stress.xy=1", "macroscopic.history=[[0, 2]]",
                             "macroscopic.stress={xy=1}", "macroscopic={strain={xx=0}}"})
    expect_survival(right_cases()[7], change);
}

// One word switches either law off and on again; what the case says beside it stays.
TEST(ResolvedInput, NumbersOfFractureStayWithoutALaw) {
  for (const auto& [file, law] : {std::pair<std::size_t, const char*>{6, "cohesive"}, {8, "bonds"}}) {
    const std::filesystem::path path = right_cases()[file];
    const std::string table = "material.rock.fracture";
    const model::Definition cracks = read_case(path);
    std::vector<std::string> off{table + ".law=none", "crack=[]", "output.fields=[]", "output.crack_surface=false"};
    if (cracks.analysis.stop_when) off.emplace_back("analysis={type='dynamic', duration=1}");
    const model::Definition whole = read_case(path, off);
    EXPECT_FALSE(whole.cracks());
    const model::Definition again = read_case_text(resolved_toml(whole), "resolved.toml");
    EXPECT_TRUE(again == whole) << resolved_toml(whole);
    // The same numbers under the law's own word.
    const auto of_rock = [](const model::Definition& definition) {
      for (const model::MaterialDefinition& material : definition.materials)
        if (material.name == "rock") return material.fracture.value();
      return material::Fracture{};
    };
    material::Fracture on = of_rock(again);
    EXPECT_FALSE(on == of_rock(cracks));
    on.law = of_rock(cracks).law;
    EXPECT_TRUE(on == of_rock(cracks)) << law;
  }
  // Neither law's numbers are needed, and those of both may stand side by side.
  for (const char* numbers : {"", ", critical_shear=1e-3", ", fracture_energy=1, critical_stretch=1e-3",
                              ", tensile_strength=1, critical_stretch=1e-3, softening='linear'"}) {
    const std::vector<std::string> off{std::string("material.rock.fracture={law='none'") + numbers + "}", "crack=[]",
                                       "output.fields=[]", "analysis={type='dynamic', duration=1}"};
    const model::Definition whole = read_case(right_cases()[8], off);
    EXPECT_TRUE(read_case_text(resolved_toml(whole), "resolved.toml") == whole) << numbers;
  }
}

TEST(ResolvedInput, WritesDefaultsInSI) {
  const std::string resolved = resolved_toml(read_case(right_cases()[2]));
  for (const char* line :
       {"spacing = 0.002\n", "springs = \"shared\"\n", "origin = [0.0, 0.0, 0.0]\n", "periodic = []\n",
        "youngs_modulus = 1112000000.0\n", "size = [0.018, 0.078, 0.018]\n", "force = [9.8, 0.0, 0.0]\n",
        "fields = [\"displacement\"]\n", "report = false\n", "tolerance = 1e-10\n"})
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

}  // namespace
}  // namespace koshi::io
