// What a misspelt name was meant to be.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace koshi {

/// The known name that is at most a few typing errors away, or starts alike and ends otherwise ("boundaries"); letter
/// case counts nothing.
std::optional<std::string> nearest(std::string_view word, std::span<const std::string> known);

/// `did you mean "spacing"?` for the nearest known name, else `known: "cell", "spacing"`; with nothing known, "none is
/// known".
std::string suggestion(std::string_view word, std::span<const std::string> known);

/// The names as `"a", "b", "c"`.
std::string quoted_list(std::span<const std::string> names);

}  // namespace koshi
