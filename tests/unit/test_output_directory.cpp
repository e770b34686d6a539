// Where results may go: what is refused leaves nothing behind, what is accepted is there and writable.
#include "io/output_directory.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mount.h>
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

  void make(const fs::path& path) { make_output_directory(world, path); }
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

}  // namespace
}  // namespace koshi::io
