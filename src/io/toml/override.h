// Overrides of the input, "section.key=value".
#pragma once

#include <string>

#include "io/toml/value.h"

namespace koshi::io {

/// Puts the value of one override into the tree; the override itself is the place of what it sets.
/// Errors: InputError for a text without key or "=", and for a path that leads nowhere.
void apply_override(Value& root, const std::string& text);

}  // namespace koshi::io
