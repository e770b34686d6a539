#include "base/console.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace koshi {
namespace {

constexpr std::string_view clear_line = "\r\x1b[K";

bool stderr_is_live() {
  const char* wish = std::getenv("KOSHI_PROGRESS");
  if (wish && std::string_view(wish) == "live") return true;
  if (wish && std::string_view(wish) == "lines") return false;
  return ::isatty(STDERR_FILENO) == 1;
}

int stderr_width() {
  winsize size{};
  if (::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
  return 80;
}

}  // namespace

Console& Console::standard() {
  static Console console([](std::string_view text) { std::fwrite(text.data(), 1, text.size(), stderr); },
                         stderr_is_live(), stderr_width);
  return console;
}

Console::Console(Write write, bool terminal, std::function<int()> width)
    : write_(std::move(write)), terminal_(terminal), width_(std::move(width)) {}

void Console::print(std::string_view line) {
  // One write, so that lines of several ranks do not mix.
  std::string text(live_.empty() ? "" : clear_line);
  text.append(line).append("\n").append(live_);
  write_(text);
}

void Console::show(std::string_view live) {
  if (!terminal_ || (live.empty() && live_.empty())) return;
  // The last column stays free: some terminals wrap when it is filled.
  std::size_t length = std::min(live.size(), static_cast<std::size_t>(std::max(width_() - 1, 1)));
  // Never half a UTF-8 character.
  while (length < live.size() && length > 0 && (live[length] & 0xC0) == 0x80) --length;
  live_ = live.substr(0, length);
  write_(std::string(clear_line) + live_);
}

}  // namespace koshi
