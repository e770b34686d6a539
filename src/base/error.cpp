#include "koshi/error.h"

#include <fmt/format.h>

#include "base/escape.h"

namespace koshi {
namespace {

std::string located(const Place& place, const std::string& message) {
  if (place.file.empty()) return fmt::format("error: {}", escaped(message));
  if (place.line == 0) return fmt::format("{}: error: {}", escaped(place.file), escaped(message));
  return fmt::format("{}:{}:{}: error: {}", escaped(place.file), place.line, place.column, escaped(message));
}

}  // namespace

InputError::InputError(const Place& place, const std::string& message)
    : std::runtime_error(located(place, message)), place_(place), message_(message) {}

}  // namespace koshi
