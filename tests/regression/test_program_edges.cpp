// The program at the edges of what its surroundings give it: names that do things, outputs that are full, environments
// that are empty, directories that are taken.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <thread>

#include "support/program_test.h"

namespace koshi {
namespace {

using test::Ended;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
using Json = nlohmann::json;
namespace fs = std::filesystem;

// A little cantilever: 4 x 7 x 4 nodes.
const std::string cantilever = R"(title = "T"
[lattice]
spacing = "1 mm"
[body]
size = ["3 mm", "6 mm", "3 mm"]
material = "rock"
[material.rock]
youngs_modulus = "1 GPa"
poissons_ratio = 0.2
density = "2000 kg/m^3"
[[boundary]]
name = "root"
face = "y-min"
fix = ["x", "y", "z", "rx", "ry", "rz"]
[[load]]
name = "tip load"
face = "y-max"
force = ["1 N", 0, 0]
[[probe]]
name = "tip"
face = "y-max"
reduce = "area-mean"
)";

const std::string motion = R"([analysis]
type = "dynamic"
duration = "0.5 ms"
[output]
every = "0.1 ms"
checkpoint_every = "0.1 ms"
)";

class Edges : public test::ProgramTest {
 protected:
  Edges() {
    test::write_file(directory_ / "static.toml", cantilever);
    test::write_file(directory_ / "motion.toml", cantilever + motion);
  }
  // After a failure of theirs, or without the list of what is known, libraries leak: not what is looked for here.
  static std::string without_leaks() { return test::without_address_sanitizer ? "" : " ASAN_OPTIONS=detect_leaks=0"; }
  Ended shell(const std::string& before, const std::string& arguments) const {
    return test::koshi(directory_.path(), arguments, "env' " + before + " '" + KOSHI_PROGRAM);
  }
};

// Timoshenko: P L^3 / (3 E I) + P L / (k G A) = 1.067e-5 + 0.188e-5 m; the warping held at the root, over half a
// height, stiffens it by a few per cent.
TEST_F(Edges, CantileverAtRest) {
  const Ended ended = koshi("run static.toml --out out --quiet");
  ASSERT_EQ(ended.code, 0) << ended.error;
  const double tip = summary("out").at("probes").at("tip").at("displacement").at(0);
  EXPECT_GT(tip, 0.95 * 1.255e-5);
  EXPECT_LT(tip, 1.255e-5);
}

// A load put on at once does the work P u; without damping it is all in springs and motion: 1 % is what the leapfrog,
// whose energies belong to half a step apart, leaves open.
TEST_F(Edges, CantileverInMotionKeepsItsEnergy) {
  const Ended ended = koshi("run motion.toml --out out --quiet");
  ASSERT_EQ(ended.code, 0) << ended.error;
  const Json result = summary("out");
  const double work = 1.0 * result.at("probes").at("tip").at("displacement").at(0).get<double>();
  const double energy =
      result.at("energy").at("elastic").get<double>() + result.at("energy").at("kinetic").get<double>();
  EXPECT_GT(work, 1e-7);
  EXPECT_NEAR(energy / work, 1, 0.01);
}

// Two runs into one directory: the second is refused while the first goes on, and takes over once it was killed.
TEST_F(Edges, TwoRunsDoNotMixTheirResults) {
  const fs::path attacks = fs::path(KOSHI_SOURCE_DIR) / "tests/attacks";
  const std::string one = attacks / "two1.toml";
  const pid_t first = ::fork();
  if (first == 0) {
    if (::chdir(directory_.path().c_str()) != 0) ::_exit(1);
    // Too long to end by itself.
    ::execl(KOSHI_PROGRAM, "koshi", "run", one.c_str(), "--out", "out", "--quiet", "--set", "analysis.duration=1000",
            nullptr);
    ::_exit(1);
  }
  while (!fs::exists(directory_ / "out/resolved.toml")) {
    ASSERT_EQ(::waitpid(first, nullptr, WNOHANG), 0) << "the first run has ended";
    std::this_thread::yield();
  }
  const std::string second = "run '" + (attacks / "two2.toml").native() + "' --out out --quiet";
  const Ended refused = koshi(second);
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.error, StartsWith("error: output directory out is in use by process " + std::to_string(first)));
  EXPECT_THAT(test::read_file(directory_ / "out/resolved.toml"), HasSubstr("density = 2000.0"));
  ASSERT_EQ(::kill(first, SIGKILL), 0);
  ASSERT_EQ(::waitpid(first, nullptr, 0), first);
  ASSERT_TRUE(fs::exists(directory_ / "out/koshi.lock"));
  const Ended after = koshi(second);
  EXPECT_EQ(after.code, 0) << after.error;
  EXPECT_THAT(test::read_file(directory_ / "out/resolved.toml"), HasSubstr("density = 4000.0"));
  EXPECT_FALSE(fs::exists(directory_ / "out/koshi.lock"));
}

// A run that ends takes nothing away from one that goes on beside it.
TEST_F(Edges, RunsBesideEachOtherKeepTheirCheckpoints) {
  const pid_t first = ::fork();
  if (first == 0) {
    if (::chdir(directory_.path().c_str()) != 0 || std::freopen("first.txt", "w", stderr) == nullptr) ::_exit(1);
    ::execl(KOSHI_PROGRAM, "koshi", "run", "motion.toml", "--out", "first", "--quiet", "--set",
            "analysis.duration=1000", nullptr);
    ::_exit(1);
  }
  const auto wait_for_checkpoint = [&](const fs::path& file) {
    while (!fs::exists(file) && ::waitpid(first, nullptr, WNOHANG) == 0) std::this_thread::yield();
    return fs::exists(file);
  };
  ASSERT_TRUE(wait_for_checkpoint(directory_ / "first/checkpoint.h5"));
  EXPECT_EQ(koshi("run motion.toml --out second --quiet").code, 0);
  // Two more: the second one began when the other run had ended.
  for (int count = 0; count < 2; ++count) {
    fs::remove(directory_ / "first/checkpoint.h5");
    ASSERT_TRUE(wait_for_checkpoint(directory_ / "first/checkpoint.h5"));
  }
  ASSERT_EQ(::kill(first, SIGTERM), 0);
  int status = 0;
  ASSERT_EQ(::waitpid(first, &status, 0), first);
  EXPECT_EQ(WEXITSTATUS(status), 1);
  EXPECT_THAT(test::read_file(directory_ / "first.txt"),
              testing::MatchesRegex("error: stopped by a signal [^\n]*--restart first/checkpoint.h5\n"));
}

TEST_F(Edges, MoreRanksThanNodesAreRefusedBeforeAnyStarts) {
  const Ended ended = koshi("run static.toml --out out --ranks 200");
  EXPECT_EQ(ended.code, 2);
  EXPECT_EQ(ended.error, "--ranks: error: 200 ranks cannot share 4 x 7 x 4 nodes; use fewer ranks\n");
  EXPECT_FALSE(fs::exists(directory_ / "out"));
}

// What could not be printed is a failure, for every command that prints.
TEST_F(Edges, FullOutputIsAFailure) {
  ASSERT_EQ(koshi("run static.toml --out out --quiet").code, 0);
  int checked = 0;
  for (const std::string command : {"--help", "--version", "schema", "check static.toml", "run static.toml --out new",
                                    "run static.toml --out several --ranks 2", "report out",
                                    "calibrate --spacing 1 --youngs-modulus 1 --poissons-ratio 0.2"}) {
    // The comment hides where the output of other tests goes.
    const Ended ended = koshi(command + " 2>'" + (directory_ / "stderr.txt").native() + "' >/dev/full #");
    EXPECT_EQ(ended.code, 1) << command;
    EXPECT_THAT(ended.error, HasSubstr("error: cannot write to the standard output: ")) << command;
    ++checked;
  }
  EXPECT_EQ(checked, 8);
}

// Files larger than memory: results that cannot be read are named, the rest by what was being made.
TEST_F(Edges, FilesBeyondMemoryAreNamed) {
  if (!test::without_address_sanitizer) GTEST_SKIP() << "under the address sanitizer";
  ASSERT_EQ(koshi("run static.toml --out out --quiet").code, 0);
  int checked = 0;
  for (const std::string file : {"summary.json", "history.csv", "resolved.toml"}) {
    const fs::path results = directory_ / ("large_" + file);
    fs::copy(directory_ / "out", results, fs::copy_options::recursive);
    fs::resize_file(results / file, 3000000000);  // a hole, no disk
    const Ended ended = test::koshi_in_small_memory(directory_.path(), "report '" + results.native() + "'");
    EXPECT_EQ(ended.code, 2) << ended.error;
    EXPECT_THAT(ended.error, HasSubstr((results / file).native())) << file;
    ++checked;
  }
  EXPECT_EQ(checked, 3);
}

// A limit on the size of files is an error of the write, as a full disk is; blocks of 512 bytes or of 1024.
TEST_F(Edges, FilesThatMayNotGrowAreAnErrorThatNamesThem) {
  const Ended ended = koshi("--version >/dev/null; ulimit -f 8; '" + std::string(KOSHI_PROGRAM) +
                            "' run static.toml --out out --quiet");
  EXPECT_EQ(ended.code, 1);
  EXPECT_EQ(ended.error, "error: cannot write out/checkpoint.h5.part: File too large\n");
  // Ranks share memory in files of their own, which MPI would wait for.
  const Ended ranks = koshi("--version >/dev/null; ulimit -f 2000; '" + std::string(KOSHI_PROGRAM) +
                            "' run static.toml --out several --quiet --ranks 2");
  EXPECT_EQ(ranks.code, 2);
  EXPECT_THAT(ranks.error, StartsWith("--ranks: error: files may have at most "));
  EXPECT_FALSE(fs::exists(directory_ / "several"));
}

// What goes wrong in a library is said in this program's words.
TEST_F(Edges, WrongOptionsOfPetscAreOneLine) {
  int checked = 0;
  for (const std::string options :
       {"lattice.spacing=2", "-options_file nowhere", "-ksp_type nosuch", "-ksp_rtol abc", "-pc_type lu"}) {
    const Ended ended = shell(without_leaks(), "run static.toml --quiet --out petsc -- " + options);
    EXPECT_EQ(ended.code, 1) << options;
    EXPECT_THAT(ended.error, testing::MatchesRegex("error: [^\n]*options after --[^\n]*\n")) << options;
    ++checked;
  }
  EXPECT_EQ(checked, 5);
  // What PETSc writes at the end comes after the results.
  const Ended late = shell(without_leaks(), "run static.toml --quiet --out petsc -- -log_view :/nowhere/at/all");
  EXPECT_EQ(late.code, 0);
  EXPECT_EQ(late.error, "warning: PETSc could not write what the options after -- ask for; check their files\n");
}

TEST_F(Edges, EmptyEnvironmentIsEnoughForOneProcess) {
  const Ended alone = shell("-i" + without_leaks(), "run static.toml --out out --quiet");
  EXPECT_EQ(alone.code, 0) << alone.error;
  EXPECT_EQ(alone.error, "");
  // Nor does it leave or share anything in the directory of temporary files.
  const fs::path temporary = directory_ / "temporary";
  const Ended apart =
      shell("TMPDIR='" + temporary.native() + "'" + without_leaks(), "run static.toml --out apart --quiet");
  EXPECT_EQ(apart.code, 0) << apart.error;
  EXPECT_FALSE(fs::exists(temporary));
  const Ended ranks = shell("-i" + without_leaks(), "run static.toml --out several --quiet --ranks 2");
  EXPECT_EQ(ranks.code, 2);
  EXPECT_THAT(ranks.error, StartsWith("--ranks: error: the environment has no PATH, where mpiexec"));
  EXPECT_FALSE(fs::exists(directory_ / "several"));
}

// Neither a terminal nor an editor nor a page gets a character that does something instead of being seen.
TEST_F(Edges, NamesAreShownEscaped) {
  const std::string escape = "\x1b", turn = "\u202e", name = "a" + turn + "b";
  const auto quiet = [&](const std::string& text) {
    return text.find(escape) == std::string::npos && text.find(turn) == std::string::npos;
  };
  std::string text = cantilever + "[output]\nreport = true\n";
  const auto replace = [&](const std::string& right, const std::string& wrong) {
    ASSERT_NE(text.find(right), std::string::npos);
    text.replace(text.find(right), right.size(), wrong);
  };
  replace("title = \"T\"", "title = \"\\u001b[31m\\u202eT\"");
  replace("name = \"tip\"", "name = \"" + name + "\"");
  replace("[material.rock]", "[material.\"\\u001b[2J\"]");
  replace("material = \"rock\"", "material = \"\\u001b[2J\"");
  test::write_file(directory_ / "names.toml", text);
  const Ended ended = koshi("run names.toml --out out");
  ASSERT_EQ(ended.code, 0) << ended.error;
  EXPECT_THAT(ended.output, HasSubstr("a\\u202Eb displacement"));
  EXPECT_TRUE(quiet(ended.output + ended.error));
  int files = 0;
  for (const char* file : {"resolved.toml", "summary.json", "history.csv", "report.html"}) {
    const std::string content = test::read_file(directory_ / "out" / file);
    EXPECT_THAT(content, HasSubstr("a\\")) << file;
    EXPECT_TRUE(quiet(content)) << file;
    ++files;
  }
  EXPECT_EQ(files, 4);
  // In JSON and TOML an escape is the character itself: nothing is lost.
  EXPECT_TRUE(summary("out").at("probes").contains(name));
  EXPECT_EQ(koshi("check out/resolved.toml").code, 0);
  EXPECT_TRUE(quiet(koshi("check names.toml").output));
  for (const std::string arguments :
       {"check names.toml --set 'x" + escape + "[2J=1'", "check 'no" + turn + "where.toml'",
        "run names.toml '--" + escape + "'", "'" + escape + "c'"}) {
    const Ended wrong = koshi(arguments);
    EXPECT_EQ(wrong.code, 2) << arguments;
    EXPECT_TRUE(quiet(wrong.error)) << arguments;
    EXPECT_THAT(wrong.error, Not(testing::IsEmpty()));
  }
}

// A spreadsheet takes a cell that begins with one of these signs for a formula: names are text, numbers stay numbers.
TEST_F(Edges, NamesInTablesAreNoFormulas) {
  int count = 0;
  for (const std::string sign : {"=", "+", "-", "@"}) {
    const std::string set = " --set 'probe.tip.name=\"" + sign + "SUM(1)\"'";
    ASSERT_EQ(koshi("run motion.toml --out out --quiet --set output.report=true" + set).code, 0);
    const std::string history = test::read_file(directory_ / "out/history.csv");
    EXPECT_THAT(history, StartsWith("time [s],'" + sign + "SUM(1).displacement.x [m],'" + sign));
    EXPECT_THAT(history, HasSubstr(",-")) << "negative numbers are numbers";
    ++count;
  }
  EXPECT_EQ(count, 4);
}

TEST_F(Edges, LoadOnHeldComponentsIsWarnedOf) {
  const std::string warning =
      "warning       load \"tip load\" acts along x on nodes that boundary \"root\" holds or moves along x: its force "
      "there "
      "goes into the support";
  EXPECT_THAT(koshi("check static.toml --set 'load.tip load.face=y-min'").output, HasSubstr(warning));
  EXPECT_THAT(koshi("run static.toml --out out --set 'load.tip load.face=y-min'").error,
              HasSubstr("warning: load \"tip load\" acts along x on nodes that boundary \"root\""));
  // A side shares only its edge with the root, and sliding nodes feel what acts along them.
  for (const char* other :
       {"'load.tip load.face=x-max'", "'boundary.root.fix=[\"y\"]' --set 'load.tip load.face=y-min'"}) {
    const Ended ended =
        koshi(std::string("check static.toml --set ") + other + " --set 'load.tip load.force=[1, 0, 0]'");
    EXPECT_EQ(ended.code, 0);
    EXPECT_THAT(ended.output, Not(HasSubstr("acts along x on nodes"))) << other;
  }
}

}  // namespace
}  // namespace koshi
