// Characters that would do something instead of being seen.
#pragma once

#include <string>
#include <string_view>

namespace koshi {

/// The text with control characters, marks that turn the direction of writing and line separators as `\u001B`,
/// `\u202E`, and bytes that are no UTF-8 as `\xFF`: a name cannot move the cursor, hide or reorder what a terminal, an
/// editor or a page shows. Line feeds stay where `keep_lines` says so.
std::string escaped(std::string_view text, bool keep_lines = false);

/// A text of a foreign file as it may stand in a message: escaped, in quotes, its first 40 characters.
std::string shown(std::string_view text);

}  // namespace koshi
