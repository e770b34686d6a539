#include "base/escape.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

namespace koshi {
namespace {

/// A character of UTF-8 and the bytes it takes; 0 bytes where there is none.
struct Character {
  std::uint32_t code = 0;
  std::size_t bytes = 0;
};

Character first_of(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  if (lead < 0x80) return {lead, 1};
  const std::size_t bytes = lead >= 0xF0 && lead < 0xF5 ? 4 : lead >= 0xE0 && lead < 0xF0 ? 3 : lead >= 0xC2 ? 2 : 0;
  if (bytes == 0 || lead >= 0xF5 || text.size() < bytes) return {};
  std::uint32_t code = lead & (0x7Fu >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return {};
    code = code << 6 | (byte(i) & 0x3Fu);
  }
  return {code, bytes};
}

bool is_seen(std::uint32_t code) {
  const auto within = [&](std::uint32_t first, std::uint32_t last) { return code >= first && code <= last; };
  return !(code < 0x20 || within(0x7F, 0x9F) || code == 0x061C || within(0x200E, 0x200F) || within(0x2028, 0x202E) ||
           within(0x2066, 0x2069) || code == 0xFEFF);
}

}  // namespace

std::string escaped(std::string_view text, bool keep_lines) {
  std::string result;
  while (!text.empty()) {
    const auto [code, bytes] = first_of(text);
    if (bytes == 0)
      result += fmt::format("\\x{:02X}", static_cast<unsigned char>(text[0]));
    else if (is_seen(code) || (keep_lines && code == '\n'))
      result += text.substr(0, bytes);
    else
      result += fmt::format("\\u{:04X}", code);
    text.remove_prefix(bytes == 0 ? 1 : bytes);
  }
  return result;
}

std::string shown(std::string_view text) {
  std::size_t end = 0;
  for (int characters = 0; characters < 40 && end < text.size(); ++characters)
    end += std::max<std::size_t>(first_of(text.substr(end)).bytes, 1);
  return '"' + escaped(text.substr(0, end)) + (end < text.size() ? "...\"" : "\"");
}

}  // namespace koshi
