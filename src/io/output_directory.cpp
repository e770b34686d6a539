#include "io/output_directory.h"

#include <fmt/format.h>

#include "base/collective.h"
#include "io/files.h"

namespace koshi::io {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& directory, const std::string& reason) {
  throw InputError(
      fmt::format("cannot create output directory {}: {}; choose another with --out", directory.native(), reason));
}

// The topmost directory that has to be made: a call that then fails removes it again.
fs::path first_missing(fs::path directory) {
  std::error_code ignored;
  while (directory.has_parent_path() && directory.parent_path() != directory &&
         !fs::exists(directory.parent_path(), ignored))
    directory = directory.parent_path();
  return directory;
}

bool holds_results(const fs::path& directory) {
  for (const char* name : {"resolved.toml", "summary.json", "paper.json"})
    if (fs::exists(directory / name)) return true;
  return false;
}

void make(const fs::path& directory) {
  std::error_code error;
  const fs::file_status status = fs::status(directory, error);
  const bool existed = fs::exists(status);
  if (existed && !fs::is_directory(status)) refuse(directory, "a file of that name exists");
  if (existed && !fs::is_empty(directory, error) && !error && !holds_results(directory))
    throw InputError(fmt::format(
        "output directory {} holds files that are no results of Koshi; choose another with --out", directory.native()));

  // Rights alone do not tell whether a file can be written (read-only and full file systems): write one.
  const fs::path made = existed ? fs::path() : first_missing(directory);
  const fs::path probe = directory / "koshi_write_test";
  fs::create_directories(directory, error);
  if (!error) error = try_replace_file(probe, "x");
  std::error_code ignored;
  if (error) {
    if (!existed) fs::remove_all(made, ignored);
    refuse(directory, error.message());
  }
  fs::remove(probe, ignored);
}

}  // namespace

void make_output_directory(const Communicator& communicator, const fs::path& directory) {
  collectively(communicator, [&] {
    if (communicator.is_root()) make(directory);
  });
}

}  // namespace koshi::io
