#include "values.h"

#include <fmt/format.h>

namespace koshi::python {

namespace py = pybind11;

io::Value value_of(const py::handle& object, const std::string& path) {
  io::Value value;
  value.place.file = path;
  // A bool is an int to Python, so it comes first.
  if (py::isinstance<py::bool_>(object)) {
    value.data = object.cast<bool>();
  } else if (py::isinstance<py::int_>(object)) {
    value.data = object.cast<std::int64_t>();
  } else if (py::isinstance<py::float_>(object)) {
    value.data = object.cast<double>();
  } else if (py::isinstance<py::str>(object)) {
    value.data = object.cast<std::string>();
  } else if (py::isinstance<py::list>(object)) {
    io::Array array;
    for (const py::handle element : object)
      array.push_back(value_of(element, fmt::format("{}[{}]", path, array.size())));
    value.data = std::move(array);
  } else if (py::isinstance<py::dict>(object)) {
    io::Table table;
    for (const auto& [key, element] : py::reinterpret_borrow<py::dict>(object)) {
      const auto name = key.cast<std::string>();
      const std::string inner = path.empty() ? name : path + "." + name;
      table.push_back({name, Place{inner, 0, 0}, value_of(element, inner)});
    }
    value.data = std::move(table);
  } else {
    throw InputError(Place{path, 0, 0}, fmt::format("the type {} is none of an input's: text, number, bool, list, dict",
                                                    py::str(object.get_type().attr("__name__")).cast<std::string>()));
  }
  return value;
}

}  // namespace koshi::python
