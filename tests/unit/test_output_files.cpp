// history.csv, summary.json and files that appear whole or not at all.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <limits>

#include "io/files.h"
#include "io/history_writer.h"
#include "io/summary.h"
#include "koshi/error.h"
#include "support/file_size_limit.h"
#include "support/temporary_directory.h"

namespace koshi::io {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

class OutputFilesTest : public testing::Test {
 protected:
  const Communicator world = Communicator::world();
  const test::TemporaryDirectory directory;
  HistoryWriter history(std::optional<double> restart_time, std::vector<std::string> columns = {"time [s]", "u [m]"}) {
    return HistoryWriter(world, directory.path(), std::move(columns), restart_time);
  }
  std::string csv() const { return read_file(directory / "history.csv"); }
};

TEST_F(OutputFilesTest, ReplacedFileIsWholeAndLeavesNothingBeside) {
  replace_file(directory / "a.txt", "first");
  replace_file(directory / "a.txt", std::string(100000, 'x') + '\0' + "end");
  EXPECT_EQ(read_file(directory / "a.txt"), std::string(100000, 'x') + '\0' + "end");
  EXPECT_FALSE(fs::exists(directory / "a.txt.part"));
}

TEST_F(OutputFilesTest, FailedReplacementKeepsTheOldFile) {
  replace_file(directory / "a.txt", "first");
  {
    const test::FileSizeLimit limit(1000);
    EXPECT_THAT([&] { replace_file(directory / "a.txt", std::string(1001, 'x')); },
                ThrowsMessage<RunError>(AllOf(HasSubstr("a.txt: File too large"), HasSubstr("cannot write"))));
  }
  EXPECT_EQ(read_file(directory / "a.txt"), "first");
  EXPECT_FALSE(fs::exists(directory / "a.txt.part"));
  EXPECT_THAT([&] { replace_file(directory / "no/a.txt", ""); },
              ThrowsMessage<RunError>(HasSubstr("No such file or directory")));
  EXPECT_THAT([&] { read_file(directory / "no"); }, ThrowsMessage<InputError>(HasSubstr("No such file or directory")));
}

TEST_F(OutputFilesTest, HistoryRowsReadBackAsTheSameDoubles) {
  const std::vector<double> values{0.1, 1.0 / 3, -1e-300, 5e-324, 123456789012345678.0, std::nextafter(1.0, 2.0)};
  auto writer = history(std::nullopt, {"time [s]", "a [m]", "b [m]", "c [m]", "d [m]", "e [m]"});
  writer.write(values);
  // Each row can be read while the writer is open.
  std::ifstream file(directory / "history.csv");
  std::string header, field;
  std::getline(file, header);
  EXPECT_EQ(header, "time [s],a [m],b [m],c [m],d [m],e [m]");
  int checked = 0;
  for (const double expected : values) {
    std::getline(file, field, checked == 5 ? '\n' : ',');
    checked += std::strtod(field.c_str(), nullptr) == expected;
  }
  EXPECT_EQ(checked, 6);
  EXPECT_THAT(csv(), HasSubstr("\n0.1,0.3333333333333333,-1e-300,"));
}

TEST_F(OutputFilesTest, HistoryNamesAreQuoted) {
  history(std::nullopt, {"time [s]", "a, \"b\".x [N]", "two\nlines"});
  EXPECT_EQ(csv(), "time [s],\"a, \"\"b\"\".x [N]\",two lines\n");
}

TEST_F(OutputFilesTest, RestartDropsLaterRowsAndTheTornOne) {
  {
    auto writer = history(std::nullopt);
    for (const double t : {0.0, 0.1, 0.2, 0.3}) writer.write(std::array{t, 10 * t});
  }
  const std::string whole = csv();
  {
    auto writer = history(0.2);
    EXPECT_EQ(csv(), "time [s],u [m]\n0,0\n0.1,1\n0.2,2\n");
    writer.write(std::array{0.3, 10 * 0.3});
  }
  EXPECT_EQ(csv(), whole);
  // A row cut off by a crash is no row.
  std::ofstream(directory / "history.csv", std::ios::app) << "0.4,4";
  history(1.0);
  EXPECT_EQ(csv(), whole);
  // A new run starts anew.
  history(std::nullopt);
  EXPECT_EQ(csv(), "time [s],u [m]\n");
}

TEST_F(OutputFilesTest, RestartRefusesOtherColumns) {
  history(std::nullopt).write(std::array{0.0, 1.0});
  EXPECT_THAT(
      [&] {
        history(0.5, {"time [s]", "v [m/s]"});
      },
      ThrowsMessage<InputError>(AllOf(HasSubstr("history.csv"), HasSubstr("choose another --out"))));
  EXPECT_EQ(csv(), "time [s],u [m]\n0,1\n") << "the file is left as it was";
  // Without a file the run starts one.
  fs::remove(directory / "history.csv");
  history(0.5, {"time [s]", "v [m/s]"});
  EXPECT_EQ(csv(), "time [s],v [m/s]\n");
}

TEST_F(OutputFilesTest, HistoryOnAFullDiskIsAnError) {
  auto writer = history(std::nullopt);
  const test::FileSizeLimit limit(100);
  int rows = 0;
  EXPECT_THAT(
      [&] {
        for (; rows < 1000; ++rows) writer.write(std::array{1.0 * rows, 2.0});
      },
      ThrowsMessage<RunError>(HasSubstr("history.csv: File too large")));
  // 15 bytes of header, 10 rows of 4 bytes, then rows of 5 bytes: the ninth of those does not fit into 100 bytes.
  EXPECT_EQ(rows, 19);
}

TEST_F(OutputFilesTest, SummaryReadsBackEqual) {
  nlohmann::ordered_json summary;
  summary["version"] = "1.2.3";
  summary["probes"]["top force"]["reaction"] = {0.1, -1.0 / 3, 1e-300};
  summary["energy"]["kinetic"] = std::numeric_limits<double>::quiet_NaN();
  write_summary(world, directory.path(), summary);
  const auto read = nlohmann::ordered_json::parse(read_file(directory / "summary.json"));
  EXPECT_EQ(read["probes"]["top force"]["reaction"], (std::vector{0.1, -1.0 / 3, 1e-300}));
  EXPECT_TRUE(read["energy"]["kinetic"].is_null());
  EXPECT_EQ(read.begin().key(), "version") << "keys keep their order";
  // A name that is no UTF-8 does not lose the file.
  summary["probes"]["\xff"] = 1;
  write_summary(world, directory.path(), summary);
  EXPECT_EQ(nlohmann::json::parse(read_file(directory / "summary.json"))["probes"].size(), 2u);
}

TEST_F(OutputFilesTest, ResolvedInputIsWrittenAsItIs) {
  write_resolved(world, directory.path(), "[lattice]\nspacing = 0.1\n");
  EXPECT_EQ(read_file(directory / "resolved.toml"), "[lattice]\nspacing = 0.1\n");
  EXPECT_THAT([&] { write_resolved(world, directory / "no", ""); },
              ThrowsMessage<RunError>(HasSubstr("No such file or directory")));
}

}  // namespace
}  // namespace koshi::io
