#include "io/history_reader.h"

#include <fmt/format.h>

#include <charconv>
#include <string_view>

#include "io/files.h"
#include "koshi/error.h"

namespace koshi::io {
namespace {

// Takes the next field off a line of RFC 4180: quoted or not, up to the next comma.
std::string next_field(std::string_view& line) {
  std::string field;
  const bool quoted = line.starts_with('"');
  if (quoted) line.remove_prefix(1);
  while (!line.empty() && (quoted || line.front() != ',')) {
    if (quoted && line.front() == '"') {
      line.remove_prefix(1);
      if (!line.starts_with('"')) break;  // a doubled quote stands for one
    }
    field += line.front();
    line.remove_prefix(1);
  }
  if (line.starts_with(',')) line.remove_prefix(1);
  return field;
}

HistoryColumn column_of(std::string header) {
  // The apostrophe that keeps spreadsheets from taking a name for a formula (history_writer.cpp).
  if (header.size() > 1 && header[0] == '\'' && std::string_view("=+-@").find(header[1]) != std::string_view::npos)
    header.erase(0, 1);
  const std::size_t bracket = header.rfind(" [");
  if (bracket == std::string::npos || !header.ends_with(']')) return {header, "1", {}};
  return {header.substr(0, bracket), header.substr(bracket + 2, header.size() - bracket - 3), {}};
}

}  // namespace

std::vector<HistoryColumn> read_history(const std::filesystem::path& path) {
  const std::string content = read_file(path);
  std::vector<HistoryColumn> columns;
  int number = 0;
  for (std::size_t begin = 0, end; (end = content.find('\n', begin)) != std::string::npos; begin = end + 1) {
    std::string_view line(content.data() + begin, end - begin);
    if (++number == 1) {
      while (!line.empty()) columns.push_back(column_of(next_field(line)));
      continue;
    }
    for (HistoryColumn& column : columns) {
      const std::string text = next_field(line);
      double value = 0;
      const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
      if (error != std::errc() || rest != text.data() + text.size())
        throw InputError(Place{path.native(), number, 0}, fmt::format("\"{}\" is no number", text));
      column.values.push_back(value);
    }
  }
  return columns;
}

}  // namespace koshi::io
