#include "io/output_directory.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <vector>

#include "base/collective.h"
#include "io/files.h"
#include "io/sample_names.h"

namespace koshi::io {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& directory, const std::string& reason) {
  throw InputError(
      fmt::format("cannot create output directory {}: {}; choose another with --out", directory.native(), reason));
}

[[noreturn]] void refuse_foreign(const fs::path& thing, const std::string& what) {
  throw InputError(
      fmt::format("{} {}; choose another output directory with --out, or move it away", thing.native(), what));
}

/// Directories made on the way; removed again, when empty, unless they are kept.
class Made {
 public:
  ~Made() {
    std::error_code ignored;
    for (auto directory = made_.rbegin(); directory != made_.rend(); ++directory) fs::remove(*directory, ignored);
  }
  void make(const fs::path& asked, const fs::path& directory) {
    std::error_code error;
    const fs::file_status itself = fs::symlink_status(directory, error);
    if (fs::is_symlink(itself) && !fs::exists(directory, error))
      refuse(asked, fmt::format("{} is a link to {}, which is not there (is a disk unmounted?)", directory.native(),
                                fs::read_symlink(directory, error).native()));
    if (fs::exists(itself)) return;
    if (directory.has_parent_path() && directory.parent_path() != directory) make(asked, directory.parent_path());
    if (fs::create_directory(directory, error)) made_.push_back(directory);
    if (error) refuse(asked, error.message());
  }
  void keep() { made_.clear(); }

 private:
  std::vector<fs::path> made_;
};

bool is_marked(const fs::path& directory) {
  std::error_code error;
  for (const char* name : {"resolved.toml", "summary.json", "paper.json", LockFile::name})
    if (fs::exists(directory / name, error)) return true;
  return false;
}

// A study that was broken off has but the directories of its runs.
bool holds_results(const fs::path& directory) {
  std::error_code error;
  return is_marked(directory) || std::all_of(fs::directory_iterator(directory, error), fs::directory_iterator(),
                                             [](const fs::path& entry) { return is_marked(entry); });
}

// Where a run writes files, nothing else may be; in fields/ nothing but samples.
void check_contents(const fs::path& directory) {
  std::error_code error;
  for (const char* name : {"resolved.toml", "summary.json", "history.csv", "fields.pvd", "checkpoint.h5",
                           "checkpoint.previous.h5", "report.html", "events.csv", "cracks.vtp"})
    if (fs::is_directory(directory / name, error))
      refuse_foreign(directory / name, "is a directory, where a file of results goes");
  const fs::path fields = directory / "fields";
  if (!fs::exists(fs::symlink_status(fields, error))) return;
  if (!fs::is_directory(fields, error)) refuse_foreign(fields, "is no directory, where samples of fields go");
  if (::access(fields.c_str(), W_OK | X_OK) != 0)
    refuse_foreign(fields, fmt::format("cannot be written ({})", system_reason(errno)));
  for (const auto& entry : fs::directory_iterator(fields))
    if (!sample_number(entry.path().filename().native()))
      refuse_foreign(entry.path(), "is no result of Koshi and stands where samples of fields go");
}

void make(const fs::path& directory, std::optional<LockFile>& lock) {
  std::error_code error;
  const fs::file_status status = fs::status(directory, error);
  const bool existed = fs::exists(status);
  if (existed && !fs::is_directory(status)) refuse(directory, "a file of that name exists");
  if (existed && !fs::is_empty(directory, error) && !error && !holds_results(directory))
    throw InputError(fmt::format(
        "output directory {} holds files that are no results of Koshi; choose another with --out", directory.native()));

  Made made;
  // A slash at the end names the same directory, and follows a link.
  made.make(directory, directory.has_filename() ? directory : directory.parent_path());
  check_contents(directory);
  // Rights alone do not tell whether a file can be written (read-only and full file systems): the lock is one.
  lock.emplace(directory);
  made.keep();
}

}  // namespace

OutputDirectory::OutputDirectory(const Communicator& communicator, const fs::path& directory) {
  collectively(communicator, [&] {
    if (communicator.is_root()) make(directory, lock_);
  });
}

}  // namespace koshi::io
