// The program from its command line: exit codes, messages, what it prints and writes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/program_test.h"

namespace koshi {
namespace {

using test::Ended;
using testing::HasSubstr;
using testing::StartsWith;
using Json = nlohmann::json;
namespace fs = std::filesystem;

const std::string small_case = R"(title = "small block"
[lattice]
spacing = "0.2 cm"
[body]
size = ["0.8 cm", "0.8 cm", "0.8 cm"]
material = "rock"
[material.rock]
youngs_modulus = "1112 MPa"
poissons_ratio = 0.18
density = "2000 kg/m^3"
[[boundary]]
name = "bottom"
face = "z-min"
fix = ["x", "y", "z", "rx", "ry", "rz"]
[[boundary]]
name = "top"
face = "z-max"
fix = ["rx", "ry", "rz"]
displacement = { z = "-0.1 mm" }
[analysis]
type = "quasi-static"
tolerance = 1e-4
[[probe]]
name = "force"
face = "z-max"
quantity = "reaction"
)";

std::string replaced(std::string text, const std::string& right, const std::string& wrong) {
  const std::size_t at = text.find(right);
  EXPECT_NE(at, std::string::npos) << right;
  return text.replace(at, right.size(), wrong);
}

class Program : public test::ProgramTest {
 protected:
  Program() { test::write_file(directory_ / "case.toml", small_case); }
};

struct Wrong {
  const char* arguments;  ///< after `koshi`
  const char* message;    ///< the start of standard error
};

// Input the model refuses, and the places it cannot write to: exit code 2, the message first, nothing left behind.
TEST_F(Program, RefusesWrongInputBeforeItMakesTheOutputDirectory) {
  test::write_file(directory_ / "empty.toml",
                   replaced(small_case, "[analysis]",
                            "[[region]]\nshape = \"box\"\nmin = [0, "
                            "0, 0]\nmax = [\"0.8 cm\", \"0.8 cm\", \"0.3 cm\"]\nmaterial = \"void\"\n[analysis]"));
  const std::size_t boundaries = small_case.find("[[boundary]]"), analysis = small_case.find("[analysis]");
  test::write_file(directory_ / "free.toml", small_case.substr(0, boundaries) + small_case.substr(analysis));
  test::write_file(directory_ / "point.toml",
                   replaced(small_case, "face = \"z-max\"\nquantity", "point = [1, 2, 3]\nquantity"));
  test::write_file(directory_ / "file", "");
  fs::create_directories(directory_ / "foreign");
  test::write_file(directory_ / "foreign/thesis.txt", "precious");

  const Wrong all[] = {
      // Found when the model is built.
      {"run empty.toml --out new",
       "empty.toml:11:1: error: boundary \"bottom\" selects only nodes without material; choose nodes of the body\n"},
      {"run point.toml --out new", "point.toml:"},
      {"run case.toml --out new --set 'boundary.bottom.face=\"z-max\"'",
       "case.toml:15:1: error: boundary \"top\" prescribes z = -0.0001 m, but boundary \"bottom\" prescribes z = 0 m "
       "at "
       "the same node; leave the component out of one of them\n"},
      {"run case.toml --out new --set 'body.size=[\"0.9 cm\", \"0.8 cm\", \"0.8 cm\"]'",
       "--set body.size=[\"0.9 cm\", \"0.8 cm\", \"0.8 cm\"]: error: size along x is 0.009 m, no positive multiple of "
       "the "
       "spacing 0.002 m; the nearest right sizes: 0.008 m, 0.01 m\n"},
      {"run case.toml --out new --set 'body.material=\"void\"'",
       "case.toml:4:1: error: the body has no solid cell; give it a material, or make the void smaller\n"},
      {"run case.toml --out new --set 'body.material=\"sand\"'",
       "--set body.material=\"sand\": error: there is no material \"sand\"; known: \"rock\", \"void\"\n"},
      {"run case.toml --out new --set 'lattice.spacing=\"0.5 um\"'",
       "--set lattice.spacing=\"0.5 um\": error: the run needs "},
      {"run free.toml --out new",
       "free.toml:12:8: error: a quasi-static run needs a support, but nothing is fixed or prescribed; add a "
       "[[boundary]], or use type = \"dynamic\"\n"},
      {"run case.toml --out new --set analysis.time_step=1",
       "--set analysis.time_step=1: error: time step 1 s is above the stable limit "},
      {"run case.toml --out new --set 'lattice.kinematics=\"least-squares\"' --set material.rock.poissons_ratio=-0.5",
       "case.toml:2:1: error: the springs of material \"rock\" (nu = -0.5): unstable: a single cell has a negative "
       "eigenvalue"},
      {"check case.toml --set 'lattice.kinematics=\"least-squares\"' --set material.rock.poissons_ratio=-0.5",
       "case.toml:2:1: error: the springs of material \"rock\" (nu = -0.5): unstable: "},
      {"check case.toml --set 'body.material=\"void\"'", "case.toml:4:1: error: the body has no solid cell"},
      // Places.
      {"run case.toml --out /proc/new/new", "error: cannot create output directory /proc/new/new: "},
      {"run case.toml --out file",
       "error: cannot create output directory file: a file of that name exists; choose another with --out\n"},
      {"run case.toml --out foreign",
       "error: output directory foreign holds files that are no results of Koshi; choose another with --out\n"},
      {"run missing.toml --out new", "missing.toml: error: cannot be opened (No such file or directory)"},
      // The command line itself.
      {"", "A subcommand is required\n"},
      {"chek case.toml", "error: there is no command \"chek\"; did you mean \"check\"?\n"},
      {"run", "case is required\n"},
      {"run case.toml --out new --fast", "error: koshi run has no option \"--fast\"; known: \"--help\", \"--out\""},
      {"run case.toml --out new --rank 2", "error: koshi run has no option \"--rank\"; did you mean \"--ranks\"?\n"},
      {"run case.toml --out new --ranks 0", "--ranks: Value 0 not in range"},
      {"run case.toml --out new --set analysis.typ=1",
       "--set analysis.typ=1: error: unknown key \"typ\" in [analysis]; did you mean \"type\"?\n"},
      {"calibrate --spacing 1 --poissons-ratio 0.6 --youngs-modulus 1", ""},
  };
  int checked = 0;
  for (const Wrong& wrong : all) {
    const Ended ended = koshi(wrong.arguments);
    EXPECT_EQ(ended.code, 2) << wrong.arguments;
    EXPECT_THAT(ended.error, StartsWith(wrong.message)) << wrong.arguments;
    EXPECT_FALSE(ended.error.empty()) << wrong.arguments;
    EXPECT_EQ(ended.output, "") << wrong.arguments;
    EXPECT_FALSE(fs::exists(directory_ / "new")) << wrong.arguments;
    ++checked;
  }
  EXPECT_EQ(checked, 24);
  EXPECT_EQ(test::read_file(directory_ / "foreign/thesis.txt"), "precious");
  EXPECT_EQ(std::distance(fs::directory_iterator(directory_ / "foreign"), fs::directory_iterator()), 1);
}

// One rank speaks for all, and the launcher adds nothing.
TEST_F(Program, RanksReportAnErrorOnce) {
  const Ended ended = koshi("run case.toml --out new --ranks 2 --set 'body.material=\"void\"'");
  EXPECT_EQ(ended.code, 2);
  EXPECT_EQ(ended.error,
            "case.toml:4:1: error: the body has no solid cell; give it a material, or make the void smaller\n");
  EXPECT_EQ(ended.output, "");
}

// The spacing offered instead of an absurd one must itself fit.
TEST_F(Program, NamesASpacingThatFitsTheMemory) {
  const Ended ended = koshi("check case.toml --set 'lattice.spacing=\"0.25 um\"'");
  EXPECT_EQ(ended.code, 2);
  double needed = 0, free = 0, spacing = 0;
  const std::size_t at = ended.error.find("the run needs");
  ASSERT_NE(at, std::string::npos) << ended.error;
  ASSERT_EQ(
      std::sscanf(
          ended.error.c_str() + at,
          "the run needs %lf GB of memory and %lf GB are free on this machine; a spacing of about %lf m would fit",
          &needed, &free, &spacing),
      3)
      << ended.error;
  // 8 mm / 0.25 um = 32000 cells a side, about 154 bytes each.
  EXPECT_NEAR(needed * 1e9 / 32000 / 32000 / 32000, 154, 8);
  const double cells = 0.008 / spacing;
  EXPECT_LT(needed * std::pow(cells / 32000, 3), free);
  EXPECT_GT(needed * std::pow(cells / 32000, 3), 0.7 * free);  // and is not far too coarse
}

TEST_F(Program, SaysItsVersionAndHelp) {
  const Ended version = koshi("--version");
  EXPECT_EQ(version.code, 0);
  EXPECT_THAT(version.output, testing::MatchesRegex("koshi [0-9]+\\.[0-9]+\\.[0-9]+\n"));
  const Ended help = koshi("--help");
  EXPECT_EQ(help.code, 0);
  for (const char* command : {"run", "check", "calibrate", "paper", "schema"})
    EXPECT_THAT(help.output, HasSubstr(std::string("\n  ") + command + " "));
}

// A column of nodes under a pressed plate: F = E A u / h within the barrelling of the rough bottom (some percent).
TEST_F(Program, RunsToRestAndWritesItsResults) {
  const Ended ended = koshi("run case.toml");
  EXPECT_EQ(ended.code, 0) << ended.error;
  EXPECT_THAT(ended.output, HasSubstr("force reaction: x = 0, y = 0, z = -"));
  EXPECT_THAT(ended.output, HasSubstr("results in case.out"));
  const Json result = summary("case.out");
  const double force = 1112e6 * 0.008 * 0.008 * 0.0001 / 0.008;
  EXPECT_NEAR(result.at("probes").at("force").at("reaction").at(2).get<double>(), -force, 0.05 * force);
  EXPECT_EQ(result.at("analysis").at("converged"), true);
  EXPECT_LT(result.at("analysis").at("residual").get<double>(), 1e-4);
  for (const char* key : {"springs", "energy", "performance", "version"}) EXPECT_TRUE(result.contains(key)) << key;
  for (const char* file : {"history.csv", "resolved.toml", "fields.pvd"})
    EXPECT_TRUE(fs::exists(directory_ / "case.out" / file)) << file;

  // The resolved input is the same run: the same numbers, bit for bit, from another directory.
  fs::create_directories(directory_ / "elsewhere");
  fs::copy_file(directory_ / "case.out/resolved.toml", directory_ / "elsewhere/again.toml");
  EXPECT_EQ(koshi("run elsewhere/again.toml --out again").code, 0);
  const Json again = summary("again");
  for (const char* key : {"probes", "springs", "energy", "analysis", "body"}) EXPECT_EQ(again.at(key), result.at(key));
  EXPECT_EQ(test::read_file(directory_ / "again/resolved.toml"),
            test::read_file(directory_ / "case.out/resolved.toml"));

  // A second run replaces the results of the first.
  EXPECT_EQ(koshi("run case.toml --set analysis.tolerance=1e-3").code, 0);
  EXPECT_LT(summary("case.out").at("analysis").at("steps"), result.at("analysis").at("steps"));
}

TEST_F(Program, QuietPrintsNothing) {
  const Ended ended = koshi("run case.toml --out out --quiet");
  EXPECT_EQ(ended.code, 0);
  EXPECT_EQ(ended.output + ended.error, "");
  EXPECT_TRUE(fs::exists(directory_ / "out/summary.json"));
}

TEST_F(Program, SetOverridesTheCase) {
  EXPECT_EQ(koshi("run case.toml --out out --quiet --set boundary.top.displacement.z='\"-0.2 mm\"' --set "
                  "material.rock.youngs_modulus='\"2 GPa\"'")
                .code,
            0);
  EXPECT_THAT(test::read_file(directory_ / "out/resolved.toml"), HasSubstr("youngs_modulus = 2000000000.0"));
  EXPECT_EQ(koshi("run case.toml --out base --quiet").code, 0);
  const auto force = [&](const char* output) {
    return summary(output).at("probes").at("force").at("reaction").at(2).get<double>();
  };
  // Linear: the force grows with the displacement and the modulus; both runs are at rest to about 1e-4.
  EXPECT_NEAR(force("out") / force("base"), 2.0 * 2000 / 1112, 1e-3);
}

// A run that is valid but fails: exit code 1, and the results so far are there.
TEST_F(Program, FailedRunsEndWithOne) {
  const Ended slow = koshi("run case.toml --out out --quiet --set analysis.duration=2e-5");
  EXPECT_EQ(slow.code, 1);
  EXPECT_THAT(slow.error, StartsWith("error: not at rest after "));
  EXPECT_THAT(slow.error, HasSubstr("the results so far are in out"));
  EXPECT_EQ(summary("out").at("analysis").at("converged"), false);

  const Ended wild = koshi(
      "run case.toml --out wild --quiet --set analysis.time_step=1e-5 --set "
      "analysis.allow_unstable_step=true");
  EXPECT_EQ(wild.code, 1);
  EXPECT_THAT(wild.error, StartsWith("error: the run diverged at or before step "));
}

TEST_F(Program, CheckSaysWhatTheCaseMeans) {
  const Ended ended = koshi("check case.toml");
  EXPECT_EQ(ended.code, 0) << ended.error;
  for (const char* text :
       {"calibration = \"bending-exact\"", "4 x 4 x 4, 64 solid", "125, 750 unknowns", "250 components", "time step ",
        "GB", "material rock", "Zener ratio 1", "Self-check", "verdict"})
    EXPECT_THAT(ended.output, HasSubstr(text)) << text;
  EXPECT_FALSE(fs::exists(directory_ / "case.out"));
}

// Table 1 of the paper [MN/m], to its printed digits.
TEST_F(Program, CalibratesToThePapersTable) {
  const struct {
    const char* cell;
    double kn, kt;
  } table[] = {{"cube-I", 1.340, 1.340}, {"cube-II", 0.605, 0.134}, {"cube-III", 0.345, 0.129}};
  for (const auto& row : table) {
    const Ended ended = koshi(std::string("calibrate --springs plain --youngs-modulus '1112 MPa' --poissons-ratio 0.18 "
                                          "--spacing '0.2 cm' --size '0.8 cm' '0.8 cm' '1.6 cm' --json --cell ") +
                              row.cell);
    ASSERT_EQ(ended.code, 0) << ended.error;
    const Json edge = Json::parse(ended.output).at("springs").at("edge");
    EXPECT_NEAR(1e-6 * edge.at("kn").get<double>(), row.kn, 0.0005) << row.cell;
    EXPECT_NEAR(1e-6 * edge.at("kt").get<double>(), row.kt, 0.0005) << row.cell;
  }
}

TEST_F(Program, SchemaIsJson) {
  const Ended ended = koshi("schema");
  EXPECT_EQ(ended.code, 0);
  const Json schema = Json::parse(ended.output);
  for (const char* section :
       {"lattice", "body", "material", "region", "selection", "boundary", "load", "analysis", "probe", "output"})
    EXPECT_TRUE(schema.at("properties").contains(section)) << section;
}

// The paper's own case, a thousandth of its compression: the probes hold vectors, the history ends with the same
// values.
TEST_F(Program, RunsTheUniaxialCaseOfThePaper) {
  const std::string file = KOSHI_SOURCE_DIR "/examples/01_uniaxial_paper/case.toml";
  const Ended ended = koshi("run " + file + " --out out --quiet --set analysis.duration='\"0.00032 s\"'");
  EXPECT_EQ(ended.code, 0) << ended.error;
  const Json result = summary("out");
  EXPECT_EQ(result.at("analysis").at("steps"), 3200);
  EXPECT_DOUBLE_EQ(result.at("analysis").at("time").get<double>(), 0.00032);
  const Json& reaction = result.at("probes").at("top force").at("reaction");
  ASSERT_EQ(reaction.size(), 3U);
  // u/h = 2e-5 and E/E0 = 1.030 (theory, section 5); waves still run after 0.3 ms, a few percent.
  EXPECT_NEAR(reaction.at(2).get<double>() / (1112e6 * 0.008 * 0.008 * 2e-5), -1.030, 0.05);
  EXPECT_EQ(result.at("probes").at("side x-max").at("displacement").size(), 3U);
  EXPECT_GT(result.at("probes").at("side x-max").at("displacement").at(0).get<double>(), 0);

  const std::string history = test::read_file(directory_ / "out/history.csv");
  const std::string last = history.substr(history.rfind('\n', history.size() - 2) + 1);
  EXPECT_DOUBLE_EQ(std::stod(last), 0.00032);  // 3200 steps of 1e-7 s, which is kept to its last bit
}

}  // namespace
}  // namespace koshi
