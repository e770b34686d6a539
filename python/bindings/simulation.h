#pragma once

#include <pybind11/pybind11.h>

namespace koshi::python {

/// Adds the class Simulation to the module.
void bind_simulation(pybind11::module_& module);

}  // namespace koshi::python
