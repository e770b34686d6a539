#include "io/lock_file.h"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <ctime>
#include <regex>

#include "io/files.h"
#include "koshi/error.h"

namespace koshi::io {
namespace {

std::string host_name() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 && name[0] != 0 ? name.data() : "an unnamed machine";
}

/// The run that a lock file tells of.
struct Holder {
  std::string host, process, start;
};

std::string text_of(const Holder& holder) {
  return fmt::format("host {}\nprocess {}\nstart {}\n", holder.host, holder.process, holder.start);
}

// Empty members for a file that does not tell: its run ended before it could write.
Holder holder_in(int descriptor) {
  std::array<char, 1024> text{};
  const ssize_t length = ::pread(descriptor, text.data(), text.size(), 0);
  static const std::regex form("host ([^\n]{1,256})\nprocess ([0-9]{1,20})\nstart ([^\n]{1,64})\n");
  std::cmatch match;
  const char* const begin = text.data();
  if (length <= 0 || !std::regex_match(begin, begin + length, match, form)) return {};
  return {match[1], match[2], match[3]};
}

// Whether the open file is still the one of that name: a run that ends removes it.
bool is_at(int descriptor, const std::filesystem::path& path) {
  struct stat opened {};
  struct stat named {};
  return ::fstat(descriptor, &opened) == 0 && ::lstat(path.c_str(), &named) == 0 && opened.st_ino == named.st_ino &&
         opened.st_dev == named.st_dev;
}

}  // namespace

LockFile::LockFile(const std::filesystem::path& directory) : path_(directory / name) {
  const auto fail = [&](const std::string& message) {
    if (descriptor_ >= 0) ::close(descriptor_);
    throw InputError(message);
  };
  const auto fail_to_write = [&](int error) {
    fail(fmt::format("cannot create output directory {}: {}; choose another with --out", directory.native(),
                     system_reason(error)));
  };
  bool locked = false;
  while (!locked) {
    descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (descriptor_ < 0) fail_to_write(errno);
    // A file system without locks gives no answer; what the file says has to do.
    const bool held = ::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    const Holder holder = holder_in(descriptor_);
    if (held)
      fail(fmt::format("output directory {} is in use by {}; wait for that run, or choose another directory with --out",
                       directory.native(),
                       holder.host.empty()
                           ? std::string("another run")
                           : fmt::format("process {} on {} since {}", holder.process, holder.host, holder.start)));
    if (!holder.host.empty() && holder.host != host_name())
      fail(
          fmt::format("output directory {} was taken by process {} on {} at {}; if that run has ended, remove {} and "
                      "start again, else choose another directory with --out",
                      directory.native(), holder.process, holder.host, holder.start, path_.native()));
    locked = is_at(descriptor_, path_);
    if (!locked) ::close(descriptor_);
  }
  const std::string text = text_of({host_name(), std::to_string(::getpid()),
                                    fmt::format("{:%Y-%m-%d %H:%M:%S} UTC", fmt::gmtime(std::time(nullptr)))});
  const bool written = ::ftruncate(descriptor_, 0) == 0 &&
                       ::pwrite(descriptor_, text.data(), text.size(), 0) == static_cast<ssize_t>(text.size()) &&
                       ::fsync(descriptor_) == 0;
  if (!written) {
    const int error = errno;
    ::unlink(path_.c_str());
    fail_to_write(error);
  }
}

LockFile::~LockFile() {
  if (is_at(descriptor_, path_)) ::unlink(path_.c_str());
  ::close(descriptor_);
}

}  // namespace koshi::io
