// The directory a run writes into.
#pragma once

#include <filesystem>
#include <optional>

#include "io/lock_file.h"
#include "koshi/communicator.h"

namespace koshi::io {

/// An output directory that one run holds for itself.
class OutputDirectory {
 public:
  /// Makes the directory and its parents where they are missing, checks that files can be written there, and keeps
  /// other runs out (collective). Make it once the input has been accepted, so that bad input leaves nothing behind.
  /// A link to a directory is as good as the directory. Throws InputError on all ranks, before anything is replaced: a
  /// place that cannot be written, with the system's reason; a link that leads nowhere; a directory that another run
  /// holds; one that holds files and no results of Koshi, or things of others where Koshi writes, so that nobody's
  /// files are mixed with results. Results of an earlier run are left to be replaced file by file.
  OutputDirectory(const Communicator& communicator, const std::filesystem::path& directory);

 private:
  std::optional<LockFile> lock_;  // of the root
};

}  // namespace koshi::io
