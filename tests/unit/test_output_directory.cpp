// Where results may go: what is refused leaves nothing behind, what is accepted is there and writable.
#include "io/output_directory.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mount.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>

#include "io/files.h"
#include "koshi/error.h"
#include "support/temporary_directory.h"

namespace koshi::io {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

class OutputDirectoryTest : public testing::Test {
 protected:
  const Communicator world = Communicator::world();
  const test::TemporaryDirectory temporary;

  void make(const fs::path& path) { const OutputDirectory made(world, path); }
  void expect_refused(const fs::path& path, const std::string& reason) {
    EXPECT_THAT([&] { make(path); }, ThrowsMessage<InputError>(AllOf(HasSubstr(path.native() + ": " + reason),
                                                                     HasSubstr("cannot create output directory"),
                                                                     HasSubstr("; choose another with --out"))));
  }
};

TEST_F(OutputDirectoryTest, IsMadeWithItsParents) {
  make(temporary / "a/b/c");
  EXPECT_TRUE(fs::is_directory(temporary / "a/b/c"));
  EXPECT_TRUE(fs::is_empty(temporary / "a/b/c")) << "nothing is left of the check";
  make(temporary / "a/b/c/");
  make(temporary / "d/");
  EXPECT_TRUE(fs::is_directory(temporary / "d"));
}

TEST_F(OutputDirectoryTest, FileInTheWayIsRefused) {
  replace_file(temporary / "file", "");
  expect_refused(temporary / "file", "a file of that name exists");
  expect_refused(temporary / "file/out", "Not a directory");
}

TEST_F(OutputDirectoryTest, OthersFilesAreRefusedAndEarlierResultsAreNot) {
  replace_file(temporary / "letter.txt", "dear");
  EXPECT_THAT([&] { make(temporary.path()); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("no results of Koshi"), HasSubstr("--out"))));
  EXPECT_EQ(read_file(temporary / "letter.txt"), "dear");
  for (const char* mark : {"summary.json", "resolved.toml", "paper.json"}) {
    replace_file(temporary / mark, "old");
    EXPECT_NO_THROW(make(temporary.path()));
    EXPECT_EQ(read_file(temporary / mark), "old");
    fs::remove(temporary / mark);
  }
}

TEST_F(OutputDirectoryTest, StudyThatWasBrokenOffIsNoForeigner) {
  fs::create_directories(temporary / "study/first");
  replace_file(temporary / "study/first/resolved.toml", "old");
  EXPECT_NO_THROW(make(temporary / "study"));
  replace_file(temporary / "study/letter.txt", "dear");
  EXPECT_THAT([&] { make(temporary / "study"); }, ThrowsMessage<InputError>(HasSubstr("no results of Koshi")));
}

TEST_F(OutputDirectoryTest, PlaceWithoutRightsIsRefused) {
  // Root may write everywhere: become somebody else for this test.
  const uid_t user = ::geteuid();
  fs::create_directory(temporary / "locked");
  fs::permissions(temporary / "locked", fs::perms::owner_read | fs::perms::owner_exec);
  fs::permissions(temporary.path(), fs::perms::owner_all | fs::perms::others_exec);
  if (user == 0) ASSERT_EQ(::seteuid(65534), 0);
  expect_refused(temporary / "locked", "Permission denied");
  expect_refused(temporary / "locked/out", "Permission denied");
  if (user == 0) ASSERT_EQ(::seteuid(user), 0);
  fs::permissions(temporary / "locked", fs::perms::owner_all);
}

// Places where not even root may write.
TEST_F(OutputDirectoryTest, ReadOnlyFileSystemIsRefused) {
  const fs::path place = temporary / "mount";
  fs::create_directory(place);
  if (::mount("koshi", place.c_str(), "tmpfs", MS_RDONLY, "size=64k") != 0)
    GTEST_SKIP() << "no right to mount a file system";
  expect_refused(place, "Read-only file system");
  expect_refused(place / "out/deep", "Read-only file system");
  ::umount(place.c_str());
}

TEST_F(OutputDirectoryTest, FullFileSystemIsRefusedAndLeftAsItWas) {
  const fs::path place = temporary / "mount";
  fs::create_directory(place);
  if (::mount("koshi", place.c_str(), "tmpfs", 0, "size=64k") != 0) GTEST_SKIP() << "no right to mount a file system";
  std::ofstream(place / "filler") << std::string(200000, 'x');
  expect_refused(place / "out/deep", "No space left on device");
  EXPECT_FALSE(fs::exists(place / "out"));
  ::umount(place.c_str());
}

TEST_F(OutputDirectoryTest, ImpossibleNamesAreRefused) {
  expect_refused("/proc/koshi/out", "No such file or directory");
  expect_refused(temporary / std::string(300, 'n'), "File name too long");
}

TEST_F(OutputDirectoryTest, LinksAreFollowedToDirectoriesAndKept) {
  fs::create_directory(temporary / "disk");
  fs::create_directory_symlink("disk", temporary / "link");
  for (const char* path : {"link", "link/", "link/deeper"}) {
    make(temporary / path);
    EXPECT_TRUE(fs::is_symlink(temporary / "link")) << path;
  }
  EXPECT_TRUE(fs::is_directory(temporary / "disk/deeper"));
}

// A disk that is not mounted: the link to it must still be there when it is.
TEST_F(OutputDirectoryTest, LinkThatLeadsNowhereIsRefusedAndKept) {
  fs::create_directory_symlink("unmounted/results", temporary / "link");
  for (const char* path : {"link", "link/", "link/deeper/still"}) {
    EXPECT_THAT([&] { make(temporary / path); },
                ThrowsMessage<InputError>(AllOf(HasSubstr("link is a link to unmounted/results, which is not there"),
                                                HasSubstr("is a disk unmounted?"))))
        << path;
    EXPECT_TRUE(fs::is_symlink(temporary / "link")) << path;
    EXPECT_EQ(fs::read_symlink(temporary / "link"), "unmounted/results");
  }
  EXPECT_FALSE(fs::exists(temporary / "unmounted"));
}

TEST_F(OutputDirectoryTest, ThingsOfOthersAreFoundBeforeAnythingIsReplaced) {
  replace_file(temporary / "resolved.toml", "old");
  fs::create_directory(temporary / "fields");
  for (const char* sample : {"sample_000000.vti", "sample_000001.pvti.part"})
    replace_file(temporary / "fields" / sample, "");
  fs::create_directory(temporary / "fields/sample_000001");
  EXPECT_NO_THROW(make(temporary.path()));
  for (const char* foreign : {"fields/crops.txt", "fields/sample_1.vti", "fields/sample_000001.txt"}) {
    replace_file(temporary / foreign, "dear");
    EXPECT_THAT([&] { make(temporary.path()); },
                ThrowsMessage<InputError>(AllOf(HasSubstr((temporary / foreign).native()),
                                                HasSubstr("is no result of Koshi"), HasSubstr("--out"))));
    EXPECT_EQ(read_file(temporary / foreign), "dear");
    fs::remove(temporary / foreign);
  }
  for (const char* name : {"summary.json", "history.csv", "fields.pvd", "checkpoint.h5", "report.html"}) {
    fs::create_directory(temporary / name);
    EXPECT_THAT([&] { make(temporary.path()); }, ThrowsMessage<InputError>(HasSubstr("is a directory, where a file")));
    fs::remove(temporary / name);
  }
  fs::remove_all(temporary / "fields");
  replace_file(temporary / "fields", "of wheat");
  EXPECT_THAT([&] { make(temporary.path()); }, ThrowsMessage<InputError>(HasSubstr("fields is no directory")));
  EXPECT_EQ(read_file(temporary / "fields"), "of wheat");
  EXPECT_EQ(read_file(temporary / "resolved.toml"), "old");
}

TEST_F(OutputDirectoryTest, SecondRunIsKeptOutUntilTheFirstHasEnded) {
  const fs::path place = temporary / "out";
  {
    const OutputDirectory first(world, place);
    EXPECT_THAT([&] { make(place); },
                ThrowsMessage<InputError>(testing::ContainsRegex(
                    "out is in use by process [0-9]+ on .+ since [0-9-]+ [0-9:]+ UTC; wait for that run, or choose")));
    EXPECT_THAT(read_file(place / "koshi.lock"),
                testing::MatchesRegex("host .+\nprocess " + std::to_string(::getpid()) + "\nstart .+ UTC\n"));
  }
  EXPECT_FALSE(fs::exists(place / "koshi.lock"));
  EXPECT_NO_THROW(make(place));
}

// A process that is killed leaves its file, not its lock.
TEST_F(OutputDirectoryTest, LockOfAKilledRunIsTakenOver) {
  const pid_t child = ::fork();
  if (child == 0) {
    new LockFile(temporary.path());
    ::_exit(0);
  }
  int status = -1;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_EQ(status, 0);
  ASSERT_THAT(read_file(temporary / "koshi.lock"), HasSubstr("process " + std::to_string(child)));
  EXPECT_NO_THROW(make(temporary.path()));
  EXPECT_FALSE(fs::exists(temporary / "koshi.lock"));
}

// Whether a run on another machine still goes on is not known here: its user decides.
TEST_F(OutputDirectoryTest, LockOfAnotherMachineSaysHowToGoOn) {
  const std::string lock = "host far.away\nprocess 12\nstart 2026-01-02 03:04:05 UTC\n";
  replace_file(temporary / "koshi.lock", lock);
  EXPECT_THAT([&] { make(temporary.path()); },
              ThrowsMessage<InputError>(
                  AllOf(HasSubstr("was taken by process 12 on far.away at 2026-01-02 03:04:05 UTC"),
                        HasSubstr("if that run has ended, remove "), HasSubstr("koshi.lock and start again"))));
  EXPECT_EQ(read_file(temporary / "koshi.lock"), lock);
}

// Neither the lock nor a file on its way is written through a link that somebody laid there.
TEST_F(OutputDirectoryTest, LinksInPlaceOfFilesAreNotFollowed) {
  replace_file(temporary / "mine", "dear");
  fs::create_directory(temporary / "out");
  fs::create_symlink("../mine", temporary / "out/koshi.lock");
  EXPECT_THROW(make(temporary / "out"), InputError);
  EXPECT_EQ(read_file(temporary / "mine"), "dear");

  fs::create_symlink("../mine", temporary / "out/result.txt");
  fs::create_symlink("../mine", temporary / "out/result.txt.part");
  replace_file(temporary / "out/result.txt", "new");
  EXPECT_EQ(read_file(temporary / "mine"), "dear");
  EXPECT_EQ(read_file(temporary / "out/result.txt"), "new");
  EXPECT_FALSE(fs::is_symlink(temporary / "out/result.txt"));
}

}  // namespace
}  // namespace koshi::io
