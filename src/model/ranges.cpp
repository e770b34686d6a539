#include "model/ranges.h"

#include <fmt/format.h>

namespace koshi::model {
namespace {

std::string quantity(double value, std::string_view unit, int digits = 6) {
  return fmt::format("{:.{}g}{}{}", value, digits, unit.empty() ? "" : " ", unit);
}

}  // namespace

std::string words(const Range& range) {
  const std::string_view unit = range.unit;
  std::string ends =
      range.open_below || range.open_above
          ? fmt::format("be {} {} and {} {}", range.open_below ? "above" : "at least", quantity(range.least, unit),
                        range.open_above ? "below" : "at most", quantity(range.most, unit))
          : fmt::format("lie between {} and {}", quantity(range.least, unit), quantity(range.most, unit));
  if (range.smallest > 0) ends += fmt::format(", and be 0 or at least {} in size", quantity(range.smallest, unit));
  return ends;
}

void require(const Range& range, const std::string& name, double value, const Place& place) {
  if (range.contains(value)) return;
  throw InputError(place, fmt::format("{} is {}; it must {}{}{}", name, quantity(value, range.unit, 12), words(range),
                                      range.reason.empty() ? "" : ", ", range.reason));
}

}  // namespace koshi::model
