// Runs that fail say what is left and how to go on; runs that go on from a checkpoint or an equilibrium.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "io/checkpoint_seal.h"
#include "io/history_reader.h"
#include "support/program_test.h"

namespace koshi {
namespace {

using test::Ended;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
namespace fs = std::filesystem;

// A bar of 40 cells along x whose material does not contract, pulled at its end. Springs without rotations stretch
// evenly under it up to the end.
const std::string bar = R"([lattice]
spacing = "1 cm"
kinematics = "least-squares"
[body]
size = ["40 cm", "1 cm", "1 cm"]
material = "steel"
[material.steel]
youngs_modulus = "200 GPa"
poissons_ratio = 0
density = "8000 kg/m^3"
[[boundary]]
name = "wall"
face = "x-min"
fix = ["x", "y", "z"]
[[load]]
name = "pull"
face = "x-max"
force = ["2 kN", "0 N", "0 N"]
[[probe]]
name = "tip"
face = "x-max"
)";
constexpr double length = 0.4, speed = 5000;  // c = sqrt(E / rho)
const std::string moving = " --set analysis.type=dynamic --set analysis.duration=5e-4 --quiet";

class Continuation : public test::ProgramTest {
 protected:
  Continuation() { test::write_file(directory_ / "bar.toml", bar); }
  // Columns of a history by their place in the header.
  std::vector<std::vector<double>> history(const fs::path& output) const {
    std::vector<std::vector<double>> columns;
    for (io::HistoryColumn& column : io::read_history(directory_ / output / "history.csv"))
      columns.push_back(std::move(column.values));
    return columns;
  }
};

// At rest the tip stands at u = F L / (E A). Released, it moves to -u and back at constant speed: a triangle of period
// 4 L / c. The discrete bar's lowest frequency is (2 c / d) sin(pi d / 4 L), lower by 6e-5.
TEST_F(Continuation, AReleasedBarSwingsAboutZero) {
  ASSERT_EQ(koshi("run bar.toml --out held --quiet").code, 0);
  const Ended released = koshi(
      "run bar.toml --out released --set load=[] --set analysis.start_from=held --set output.history_every=1e-6"
      " --set analysis.type=dynamic --set analysis.duration=1.6e-3 --quiet");
  ASSERT_EQ(released.code, 0) << released.error;
  const auto columns = history("released");
  const std::vector<double>&time = columns[0], &u = columns[1];
  ASSERT_GT(time.size(), 800U);
  const double still = 2000 * length / (200e9 * 1e-4), period = 4 * length / speed;
  EXPECT_NEAR(u[0], still, 1e-6 * still);
  std::vector<double> crossings;
  for (std::size_t s = 1; s < u.size(); ++s)
    if ((u[s] > 0) != (u[s - 1] > 0))
      crossings.push_back(time[s - 1] + (time[s] - time[s - 1]) * u[s - 1] / (u[s - 1] - u[s]));
  // Five periods: at a quarter, three quarters and so on.
  ASSERT_EQ(crossings.size(), 10U);
  for (std::size_t n = 0; n < crossings.size(); ++n)
    EXPECT_NEAR(crossings[n] / period, 0.25 + 0.5 * static_cast<double>(n), 0.01);
  const auto [least, most] = std::minmax_element(u.begin(), u.end());
  // Its corners ripple by a few per cent, as a lattice's waves of different lengths travel at different speeds.
  EXPECT_NEAR(*least / still, -1, 0.06);
  EXPECT_NEAR(*most / still, 1, 0.06);
}

TEST_F(Continuation, AStepAboveTheLimitIsRefusedWithTheLimit) {
  const Ended ended = koshi("run bar.toml --out new --set analysis.time_step=1e-3" + moving);
  EXPECT_EQ(ended.code, 2);
  const std::string words = "is above the stable limit ";
  const std::size_t at = ended.error.find(words);
  ASSERT_NE(at, std::string::npos) << ended.error;
  const double limit = std::stod(ended.error.substr(at + words.size()));
  // The limit is printed with four digits; omega_max of a bar one cell thick is above c_p / d.
  EXPECT_GT(limit, 0.01 / speed / 10);
  EXPECT_LT(limit, 0.01 / speed);
  const auto run = [&](double step) {
    return koshi("run bar.toml --out new --set analysis.time_step=" + std::to_string(1e9 * step) + "e-9" + moving).code;
  };
  EXPECT_EQ(run(1.002 * limit), 2);
  EXPECT_EQ(run(0.998 * limit), 0);
}

// On several ranks the reason is told once, and not drowned by what the launcher has to say.
TEST_F(Continuation, ADivergedRunNamesNodeAndCheckpoints) {
  std::vector<std::string> messages;
  for (const char* ranks : {"1", "2"}) {
    const Ended ended = koshi(std::string("run bar.toml --out wild --set analysis.time_step=2.2e-6 --set "
                                          "analysis.allow_unstable_step=true --set output.checkpoint_every=1e-5 "
                                          "--ranks ") +
                              ranks + moving);
    EXPECT_EQ(ended.code, 1);
    EXPECT_THAT(ended.error, StartsWith("error: the run diverged at or before step "));
    EXPECT_THAT(ended.error, HasSubstr(": node ("));
    EXPECT_THAT(ended.error, HasSubstr("; the diverged state is kept in wild/diverged/checkpoint.h5; the last "
                                       "checkpoint is whole: --restart wild/checkpoint.h5\n"));
    EXPECT_EQ(std::ranges::count(ended.error, '\n'), 1) << ended.error;
    for (const char* file : {"wild/diverged/checkpoint.h5", "wild/checkpoint.h5"})
      EXPECT_TRUE(fs::exists(directory_ / file)) << file;
    messages.push_back(ended.error);
    fs::remove_all(directory_ / "wild");
  }
  EXPECT_EQ(messages[0], messages[1]);
}

// A checkpoint that cannot be written ends the run; the older one stays, is named, and leads to the same end.
TEST_F(Continuation, AFailedCheckpointLeavesTheOlderOne) {
  const std::string run = "run bar.toml --set output.checkpoint_every=1e-4" + moving;
  ASSERT_EQ(koshi(run + " --out whole").code, 0);
  // As if that run had ended before its last checkpoint.
  fs::copy(directory_ / "whole", directory_ / "out", fs::copy_options::recursive);
  fs::rename(directory_ / "out/checkpoint.previous.h5", directory_ / "out/checkpoint.h5");
  const std::string older = test::read_file(directory_ / "out/checkpoint.h5");
  EXPECT_FALSE(older == test::read_file(directory_ / "whole/checkpoint.h5"));
  fs::create_directory(directory_ / "out/checkpoint.h5.part");
  const Ended ended = koshi(run + " --out out --restart out/checkpoint.h5");
  EXPECT_EQ(ended.code, 1);
  EXPECT_EQ(ended.error,
            "error: cannot write out/checkpoint.h5.part: Is a directory; the last checkpoint is whole: "
            "--restart out/checkpoint.h5\n");
  EXPECT_TRUE(test::read_file(directory_ / "out/checkpoint.h5") == older);
  fs::remove(directory_ / "out/checkpoint.h5.part");
  EXPECT_EQ(koshi(run + " --out out --restart out/checkpoint.h5").code, 0);
  for (const char* file : {"history.csv", "checkpoint.h5"})
    EXPECT_TRUE(test::read_file(directory_ / "out" / file) == test::read_file(directory_ / "whole" / file)) << file;

  // One that is damaged later is refused, and the one before it leads to the same end as well.
  const fs::path last = directory_ / "out/checkpoint.h5";
  fs::resize_file(last, fs::file_size(last) - 1);
  const Ended damaged = koshi(run + " --out out --restart out");
  EXPECT_EQ(damaged.code, 2);
  EXPECT_THAT(damaged.error, HasSubstr(" is cut short: "));
  EXPECT_THAT(damaged.error, HasSubstr("; try out/checkpoint.previous.h5\n"));
  EXPECT_EQ(koshi(run + " --out out --restart out/checkpoint.previous.h5").code, 0);
  EXPECT_TRUE(test::read_file(last) == test::read_file(directory_ / "whole/checkpoint.h5"));

  const Ended other = koshi(run + " --out out --restart out --set material.steel.poissons_ratio=0.1");
  EXPECT_EQ(other.code, 2);
  EXPECT_THAT(other.error, HasSubstr("is of another case: in [material.steel] `poissons_ratio = 0.0` there, "
                                     "`poissons_ratio = 0.1` here"));
}

// 80 us are 200 and 320 us 800 steps of 0.4 us: a run that is given more time takes the steps of one that had it from
// the start, byte for byte, and one that is given less is refused.
TEST_F(Continuation, AnotherDurationKeepsTheStep) {
  const std::string run =
      "run bar.toml --quiet --set analysis.type=dynamic --set analysis.time_step=4e-7 --set "
      "output.checkpoint_every=1 --set output.history_every=1e-5 --set analysis.duration=";
  ASSERT_EQ(koshi(run + "3.2e-4 --out whole").code, 0);
  ASSERT_EQ(koshi(run + "8e-5 --out out").code, 0);
  const Ended shorter = koshi(run + "4e-5 --out out --restart out");
  EXPECT_EQ(shorter.code, 2);
  EXPECT_THAT(shorter.error, HasSubstr("out is of t = 8e-05 s, after the end of a run of 4e-05 s; give a duration of "
                                       "more than 8e-05 s"));
  ASSERT_EQ(koshi(run + "3.2e-4 --out out --restart out").code, 0);
  for (const char* file : {"history.csv", "checkpoint.h5"}) {
    const std::string whole = test::read_file(directory_ / "whole" / file);
    EXPECT_GT(whole.size(), 1000U) << file;
    EXPECT_TRUE(test::read_file(directory_ / "out" / file) == whole) << file;
  }

  // An automatic step divides the first duration, not the second: it is kept all the same, and the end is passed by
  // less than a step.
  const std::string automatic =
      "run bar.toml --quiet --set analysis.type=dynamic --set output.checkpoint_every=1 --set "
      "analysis.duration=";
  const auto end = [&] { return summary("auto")["analysis"]; };
  ASSERT_EQ(koshi(automatic + "8e-5 --out auto").code, 0);
  const double step = end()["time_step"].get<double>();
  EXPECT_NEAR(end()["time"].get<double>(), 8e-5, 1e-18);
  ASSERT_EQ(koshi(automatic + "1.1234e-4 --out auto --restart auto").code, 0);
  EXPECT_EQ(end()["time_step"].get<double>(), step);
  EXPECT_GE(end()["time"].get<double>(), 1.1234e-4);
  EXPECT_LT(end()["time"].get<double>(), 1.1234e-4 + step);
}

// 4 GB of bar do not fit into an address space of 1.5 GB: said before anything is made.
TEST_F(Continuation, ALimitOfTheAddressSpaceIsRespected) {
  if (!test::without_address_sanitizer) GTEST_SKIP() << "under the address sanitizer";
  const Ended ended = test::koshi_in_small_memory(
      directory_.path(), "run bar.toml --out new --set 'body.size=[\"40 cm\", \"4 m\", \"4 m\"]'");
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.error,
              testing::ContainsRegex("the run needs [0-9.]+ GB of memory and [01]\\.[0-9]+ GB are free within "
                                     "the limit of a process's address space \\(ulimit -v\\); a spacing of "
                                     "about [0-9.]+ m would fit"));
  EXPECT_FALSE(fs::exists(directory_ / "new"));
}

// A stiff body that hangs in a softer one is found up to eight orders of magnitude; beyond, the message says the limit.
// What ended the iterations is said in words, not by a library's constant.
TEST_F(Continuation, StrongContrastsAreSolvedOrSaidToBeBeyondReach) {
  std::string text = bar + "[material.jelly]\nyoungs_modulus = \"200 GPa\"\npoissons_ratio = 0\ndensity = 1000\n";
  text += "[[region]]\nshape = \"box\"\nmaterial = \"jelly\"\nmin = [0, 0, 0]\nmax = [\"20 cm\", \"1 cm\", \"1 cm\"]\n";
  test::write_file(directory_ / "soft.toml", text);
  // The soft half stretches by F L / (2 E A), the stiff one by next to nothing.
  ASSERT_EQ(koshi("run soft.toml --out soft --quiet --set material.jelly.youngs_modulus=2000").code, 0);
  const double u = history("soft")[1].back();
  EXPECT_NEAR(u / (2000 * length / 2 / (2000 * 1e-4)), 1, 1e-4);
  EXPECT_EQ(summary("soft")["analysis"]["reason"], "relative residual below the tolerance");
  // The soft half made soft by its material, or by a factor on its cells (NumPy: z, y, x).
  int checked = 0;
  for (const auto& [factor, words] :
       std::map<float, std::string>{{1e-9f, "1e+09"}, {1e-10f, "1e+10"}, {1e-12f, "1e+12"}, {1e-15f, "1e+15"}}) {
    std::string header = "{'descr': '<f4', 'fortran_order': False, 'shape': (1, 1, 40), }";
    header.resize(117, ' ');
    std::vector<float> cells(40, 1);
    std::fill_n(cells.begin(), 20, factor);
    test::write_file(directory_ / "factor.npy", "\x93NUMPY\x01" + std::string{'\0', 'v', '\0'} + header + "\n" +
                                                    std::string(reinterpret_cast<const char*>(cells.data()), 160));
    for (const std::string arguments : {fmt::format("soft.toml --set material.jelly.youngs_modulus={}", 2e11f * factor),
                                        std::string("bar.toml --set body.factor=\\\"factor.npy\\\"")}) {
      const Ended beyond = koshi("run --out soft --quiet " + arguments);
      EXPECT_EQ(beyond.code, 1) << arguments;
      EXPECT_THAT(beyond.error, HasSubstr("the stiffest cell has " + words + " times the stiffness of the softest"));
      EXPECT_THAT(beyond.error, Not(HasSubstr("DIVERGED")));
      ++checked;
    }
  }
  EXPECT_EQ(checked, 8);
}

// A checkpoint made by hand, with a right seal: a step that is none, or that would take forever, is refused.
TEST_F(Continuation, AStepThatNoRunCanTakeIsRefused) {
  ASSERT_EQ(koshi("run bar.toml --out out --set output.checkpoint_every=1" + moving).code, 0);
  const fs::path file = directory_ / "out/checkpoint.h5";
  const std::string whole = test::read_file(file);
  const Communicator world = Communicator::world();
  const io::Bytes place = io::check_seal(file, world).index;
  const std::string index = whole.substr(place.offset, place.count);
  const std::size_t begin = index.find("scalar "), end = index.find(" time_step\n");
  ASSERT_LT(begin, end);
  ASSERT_NE(end, std::string::npos);
  int refused = 0;
  for (const std::string step : {"0", "-1e-06", "nan", "inf", "1e-300"}) {
    const std::string forged = index.substr(0, begin) + "scalar " + step + index.substr(end);
    test::write_file(file, whole + forged);
    io::seal_checkpoint(file, {whole.size(), forged.size()}, world);
    const Ended ended = koshi("run bar.toml --out out --restart out --set output.checkpoint_every=1" + moving +
                              " --set analysis.duration=1e-3");
    EXPECT_EQ(ended.code, 2) << step << ended.error;
    EXPECT_THAT(ended.error,
                step == "1e-300" ? HasSubstr("1e+12 can be made") : HasSubstr("has a time step of " + step));
    ++refused;
  }
  EXPECT_EQ(refused, 5);
}

TEST_F(Continuation, AnEquilibriumLeavesNothingToDo) {
  ASSERT_EQ(koshi("run bar.toml --out out --quiet").code, 0);
  const std::string summary = test::read_file(directory_ / "out/summary.json");
  const Ended ended = koshi("run bar.toml --out out --quiet --restart out");
  EXPECT_EQ(ended.code, 2);
  EXPECT_EQ(ended.error,
            "error: nothing is left to do: out holds the equilibrium of this case; without --restart it is "
            "computed anew\n");
  EXPECT_EQ(test::read_file(directory_ / "out/summary.json"), summary);
}

// Fields may change at a restart: the page shows those that all samples have, and says which are left out.
TEST_F(Continuation, OtherFieldsAreAcceptedToTheEnd) {
  const std::string run =
      "run bar.toml --quiet --set analysis.type=dynamic --set output.checkpoint_every=1 --set "
      "output.every=4e-5 --set output.report=true --out out --set ";
  int checked = 0;
  for (const char* first : {"[]", "[\"displacement\", \"stress\"]", "[\"velocity\"]"})
    for (const char* second : {"[]", "[\"displacement\"]", "[\"stress\", \"energy\"]"}) {
      ASSERT_EQ(koshi(run + "analysis.duration=8e-5 --set 'output.fields=" + first + "'").code, 0);
      const Ended ended = koshi(run + "analysis.duration=1.6e-4 --restart out --set 'output.fields=" + second + "'");
      EXPECT_EQ(ended.code, 0) << first << " " << second << ": " << ended.error;
      EXPECT_TRUE(fs::exists(directory_ / "out/report.html"));
      if (std::string(first).size() > 20 && std::string(second).size() > 20)
        EXPECT_THAT(test::read_file(directory_ / "out/report.html"),
                    HasSubstr("Not in all samples and left out: displacement, energy."));
      fs::remove_all(directory_ / "out");
      ++checked;
    }
  EXPECT_EQ(checked, 9);
}

// The page is asked for at the end: whether there is one is known at the start.
TEST_F(Continuation, AReportWithoutItsPageIsRefusedAtTheStart) {
  const fs::path program = directory_ / "koshi";  // away from the page beside the program
  fs::copy_file(KOSHI_PROGRAM, program);
  const Ended ended =
      test::koshi(directory_.path(), "run bar.toml --out new --set output.report=true" + moving, program.native());
  EXPECT_EQ(ended.code, 1);
  EXPECT_THAT(ended.error, StartsWith("error: the template of reports is not installed"));
  EXPECT_FALSE(fs::exists(directory_ / "new"));
}

}  // namespace
}  // namespace koshi
