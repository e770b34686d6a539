#include "base/log.h"

#include <string>

#include "base/console.h"
#include "base/escape.h"

namespace koshi {
namespace {

LogLevel& level() {
  static LogLevel current;
  return current;
}

}  // namespace

void set_log_level(const LogLevel& wanted) { level() = wanted; }

void log_information(std::string_view text) {
  if (level().information) Console::standard().print(escaped(text));
}

void log_warning(std::string_view text) {
  if (level().warnings) Console::standard().print("warning: " + escaped(text));
}

}  // namespace koshi
