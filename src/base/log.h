// Messages to the user besides results and errors; they do not tear the progress line.
#pragma once

#include <string_view>

namespace koshi {

/// Which messages are shown: all by default. A program silences the ranks other than the root, and with --quiet the
/// information.
struct LogLevel {
  bool information = true;
  bool warnings = true;
};
void set_log_level(const LogLevel& level);

/// Something worth knowing, e.g. a choice Koshi made.
void log_information(std::string_view text);

/// Something the user should look at; printed as "warning: text".
void log_warning(std::string_view text);

}  // namespace koshi
