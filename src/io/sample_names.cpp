#include "io/sample_names.h"

#include <fmt/format.h>

#include <regex>

namespace koshi::io {

std::string sample_name(std::uint64_t number) { return fmt::format("sample_{:06}", number); }

std::optional<std::uint64_t> sample_number(const std::string& name) {
  static const std::regex form(R"(sample_(\d{6,18})(|\.part|\.vti|\.vti\.part|\.pvti|\.pvti\.part))");
  std::smatch match;
  if (!std::regex_match(name, match, form)) return std::nullopt;
  return std::stoull(match[1]);
}

}  // namespace koshi::io
