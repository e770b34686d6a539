// A file that says which run writes into a directory.
#pragma once

#include <filesystem>
#include <string>

namespace koshi::io {

/// Holds "koshi.lock" in a directory: host, process and start of the run. The system drops its lock with the process,
/// so the file of a run that was killed on this machine is taken over; one from another machine is not, since nobody
/// here knows whether that run still goes on.
class LockFile {
 public:
  static constexpr const char* name = "koshi.lock";

  /// Throws InputError when another run holds the directory or may hold it, or with the system's reason when the file
  /// cannot be written; a file that is not this run's stays as it was.
  explicit LockFile(const std::filesystem::path& directory);
  ~LockFile();
  LockFile(const LockFile&) = delete;
  LockFile& operator=(const LockFile&) = delete;

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
};

}  // namespace koshi::io
