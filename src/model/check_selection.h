// Checks of selections.
#pragma once

#include <string>
#include <vector>

#include "model/check.h"

namespace koshi::model {

/// The keys that a selection gives.
std::vector<std::string> given_keys(const Selection& selection);

/// One selection: `path` is its table, `title` names it in messages; `known` is how many of the named selections it may
/// refer to, the first ones.
void check_selection(const Checker& check, const std::string& path, const std::string& title,
                     const Selection& selection, std::size_t known);
/// The same where it may refer to all.
void check_selection(const Checker& check, const std::string& path, const std::string& title,
                     const Selection& selection);

/// A name at the key `path` that must be one of a [[selection]].
void check_named_selection(const Checker& check, const std::string& path, const std::string& name);

/// Names of regions, and [[selection]].
void check_selections(const Checker& check);

}  // namespace koshi::model
