#include "io/voxels/header_text.h"

#include <fmt/format.h>

#include <charconv>

#include "koshi/error.h"

namespace koshi::io {
namespace {

constexpr std::uint64_t longest_line = 16384, longest_header = 1 << 20;
constexpr const char* blanks = " \t";

template <class T>
std::optional<T> number(std::string_view text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

HeaderLines::HeaderLines(const InputFile& file) : file_(file) {}

std::optional<std::string> HeaderLines::next() {
  if (at_ >= file_.size()) return std::nullopt;
  ++number_;
  std::string line = file_.text(at_, at_ + 256);
  std::size_t end = line.find('\n');
  if (end == std::string::npos) {
    line = file_.text(at_, at_ + longest_line);
    end = line.find('\n');
  }
  if (end == std::string::npos && line.size() == longest_line)
    throw InputError(
        fmt::format("has a header with a line of more than {} characters, line {}", longest_line, number_));
  if (at_ > longest_header) throw InputError(fmt::format("has a header of more than {} bytes", longest_header));
  at_ += end == std::string::npos ? line.size() : end + 1;
  if (end != std::string::npos) line.resize(end);
  if (line.ends_with('\r')) line.pop_back();
  return line;
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) + 1 - first);
}

std::vector<std::string_view> words(std::string_view text) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = text.find_first_not_of(blanks); begin != std::string_view::npos;) {
    const std::size_t end = text.find_first_of(blanks, begin);
    parts.push_back(text.substr(begin, end - begin));
    begin = text.find_first_not_of(blanks, end);
  }
  return parts;
}

std::optional<std::int64_t> whole_number(std::string_view text) { return number<std::int64_t>(text); }
std::optional<double> real_number(std::string_view text) { return number<double>(text); }

}  // namespace koshi::io
