// Python objects as the tree of values that the input's reader takes.
#pragma once

#include <pybind11/pybind11.h>

#include "io/toml/value.h"

namespace koshi::python {

/// A dict, list, text, number or bool, with what it holds. Places are paths ("boundary[0].fix").
/// Errors: InputError for any other type.
io::Value value_of(const pybind11::handle& object, const std::string& path);

}  // namespace koshi::python
