#include "io/history_writer.h"

#include <fmt/format.h>

#include <cassert>
#include <cerrno>
#include <charconv>

#include "base/collective.h"
#include "base/escape.h"
#include "io/files.h"

namespace koshi::io {
namespace {

// A name as a CSV field (RFC 4180), on one line. Spreadsheets take what begins with one of the signs for a formula, and
// with an apostrophe before it for text.
std::string quoted(std::string name) {
  for (char& c : name)
    if (c == '\n' || c == '\r') c = ' ';
  name = escaped(name);
  if (!name.empty() && std::string_view("=+-@").find(name[0]) != std::string_view::npos) name = "'" + name;
  if (name.find_first_of(",\"") == std::string::npos) return name;
  std::string field = "\"";
  for (const char c : name) {
    field += c;
    if (c == '"') field += c;
  }
  return field + '"';
}

// The header and the whole rows up to and including the time; a row cut off by the end of the file is dropped.
std::string rows_until(const std::filesystem::path& path, const std::string& header, double time) {
  const std::string content = read_file(path);
  if (!content.starts_with(header))
    throw InputError(fmt::format("{} has other columns than this run; choose another --out", path.native()));
  std::size_t end = header.size();
  for (std::size_t next; (next = content.find('\n', end)) != std::string::npos; end = next + 1) {
    double t = 0;
    const auto [rest, error] = std::from_chars(content.data() + end, content.data() + next, t);
    if (error != std::errc() || t > time) break;
  }
  return content.substr(0, end);
}

}  // namespace

HistoryWriter::HistoryWriter(const Communicator& communicator, const std::filesystem::path& directory,
                             std::vector<std::string> columns, std::optional<double> restart_time)
    : communicator_(communicator), path_(directory / "history.csv"), columns_(columns.size()) {
  collectively(communicator_, [&] {
    if (!communicator_.is_root()) return;
    for (std::string& column : columns) column = quoted(column);
    const std::string header = fmt::format("{}\n", fmt::join(columns, ","));
    const bool go_on = restart_time && std::filesystem::exists(path_);
    replace_file(path_, go_on ? rows_until(path_, header, *restart_time) : header);
    file_.reset(std::fopen(path_.c_str(), "a"));
    if (!file_) throw RunError(fmt::format("cannot write {}: {}", path_.native(), system_reason(errno)));
  });
}

void HistoryWriter::write(std::span<const double> row) {
  collectively(communicator_, [&] {
    if (!communicator_.is_root()) return;
    assert(row.size() == columns_);
    const std::string line = fmt::format("{}\n", fmt::join(row, ","));
    if (std::fwrite(line.data(), 1, line.size(), file_.get()) != line.size() || std::fflush(file_.get()) != 0)
      throw RunError(fmt::format("cannot write {}: {}", path_.native(), system_reason(errno)));
  });
}

}  // namespace koshi::io
