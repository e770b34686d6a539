// Input that is no file: a tree of values made by a program.
#pragma once

#include <span>
#include <string>

#include "io/toml/value.h"
#include "koshi/definition.h"

namespace koshi::io {

/// As read_case (koshi/input.h), from the values of a whole input; relative file names start from `directory`.
model::Definition read_case_values(Value root, const std::string& directory, std::span<const std::string> overrides);

}  // namespace koshi::io
