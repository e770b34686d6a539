// Values over time, one row per sample (docs/formats/output.md).
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "koshi/communicator.h"

namespace koshi::io {

/// Writes `history.csv` into the output directory: a header of names with units, then a row per sample. Numbers are the
/// shortest that read back as the same double. Every row is handed to the system at once, so that a reader can follow.
class HistoryWriter {
 public:
  /// `columns`: names with units, the first one the time, e.g. "time [s]", "top force.reaction.x [N]". A new run starts
  /// a new file; a run restarted at `restart_time` drops the rows after that time and goes on (collective). Throws
  /// InputError when the file to go on with has other columns, RunError when it cannot be written.
  HistoryWriter(const Communicator& communicator, const std::filesystem::path& directory,
                std::vector<std::string> columns, std::optional<double> restart_time);

  /// Adds a row, one value per column (collective; the root's values count). Throws RunError with the system's reason
  /// on all ranks.
  void write(std::span<const double> row);

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  Communicator communicator_;
  std::filesystem::path path_;
  [[maybe_unused]] std::size_t columns_;    // checked in debug builds
  std::unique_ptr<std::FILE, Close> file_;  // on the root
};

}  // namespace koshi::io
