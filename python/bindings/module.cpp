// The extension under the Python package koshi: what the package needs of the library, without defaults of its own.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>

#include "calibration/calibrate.h"
#include "io/cell_image.h"
#include "io/toml/read.h"
#include "koshi/communicator.h"
#include "koshi/input.h"
#include "simulation.h"
#include "values.h"

namespace py = pybind11;

namespace koshi::python {
namespace {

using Values = py::array_t<std::int64_t, py::array::c_style>;
using Factors = py::array_t<float, py::array::c_style>;

// An array [z][y][x] in place of a file with a value for each cell; numpy has made its values whole or single.
template <class T>
io::CellImage image_of(const py::array_t<T, py::array::c_style>& values) {
  const Int3 cells{values.shape(2), values.shape(1), values.shape(0)};
  return {cells, {1, cells[0], cells[0] * cells[1]}, [data = values.data()](std::int64_t i) {
            return static_cast<double>(data[i]);
          }};
}

// Each sets what the file would have given, and forgets the file.
void set_cells(model::Definition& definition, const Values& values) {
  io::set_cells(image_of(values), definition);
  definition.body.image.clear();
}

void set_factors(model::Definition& definition, const Factors& values) {
  io::set_factors(image_of(values), definition);
  definition.body.factor.clear();
}

void set_strengths(model::Definition& definition, const Factors& values) {
  io::set_strengths(image_of(values), definition);
  definition.body.strength.clear();
}

void set_grain_labels(model::Definition& definition, const Values& values) {
  io::set_grain_labels(image_of(values), definition);
  definition.body.grain_boundary->labels.clear();
}

std::string calibrate(const model::Definition& definition, bool of_body) {
  const auto size = of_body ? std::optional(definition.body.size) : std::nullopt;
  return calibration::calibration_json(
             calibration::calibrate(definition.lattice, definition.materials.front().elastic, size))
      .dump();
}

}  // namespace
}  // namespace koshi::python

PYBIND11_MODULE(_koshi, module) {
  using namespace koshi;
  module.attr("__version__") = KOSHI_VERSION;
  py::register_exception<InputError>(module, "InputError", PyExc_ValueError);
  py::register_exception<RunError>(module, "RunError", PyExc_RuntimeError);

  // Whoever starts the message-passing layer ends it: mpi4py, if it was imported before, else this module.
  if (!Environment::is_running()) {
    auto environment = std::make_shared<std::unique_ptr<Environment>>(std::make_unique<Environment>(nullptr, nullptr));
    py::module_::import("atexit").attr("register")(py::cpp_function([environment] { environment->reset(); }));
  }

  py::class_<model::Definition>(module, "Definition")
      .def("resolved_toml", [](const model::Definition& definition) { return io::resolved_toml(definition); })
      .def("set_cells", python::set_cells)
      .def("set_factors", python::set_factors)
      .def("set_strengths", python::set_strengths)
      .def("set_grain_labels", python::set_grain_labels);
  module.def("read_case", [](const std::string& file, const std::vector<std::string>& overrides) {
    return io::read_case(file, overrides);
  });
  module.def("read_values", [](const py::dict& values, const std::vector<std::string>& overrides) {
    return io::read_case_values(python::value_of(values, ""), ".", overrides);
  });
  module.def("calibrate", python::calibrate);
  python::bind_simulation(module);
}
