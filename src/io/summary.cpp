#include "io/summary.h"

#include <fmt/format.h>

#include "base/collective.h"
#include "base/escape.h"
#include "io/files.h"

namespace koshi::io {

void write_summary(const Communicator& communicator, const std::filesystem::path& directory,
                   const nlohmann::ordered_json& summary) {
  collectively(communicator, [&] {
    // Names are the user's: bytes that are no UTF-8 are replaced instead of losing the whole file; what an editor would
    // not show is escaped, which means the same to a reader of JSON.
    constexpr auto replace = nlohmann::ordered_json::error_handler_t::replace;
    if (communicator.is_root())
      replace_file(directory / "summary.json", escaped(summary.dump(2, ' ', false, replace), true) + "\n");
  });
}

void write_table(const Communicator& communicator, const std::filesystem::path& file,
                 const std::vector<std::string>& columns, const std::vector<std::vector<double>>& rows) {
  std::string text = fmt::format("{}\n", fmt::join(columns, ","));
  for (const std::vector<double>& row : rows) text += fmt::format("{}\n", fmt::join(row, ","));
  collectively(communicator, [&] {
    if (communicator.is_root()) replace_file(file, text);
  });
}

void write_resolved(const Communicator& communicator, const std::filesystem::path& directory, std::string_view toml) {
  collectively(communicator, [&] {
    if (communicator.is_root()) replace_file(directory / "resolved.toml", toml);
  });
}

}  // namespace koshi::io
