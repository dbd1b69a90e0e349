// The definition of a monitor as Python has it: error bounds, classes, separations, shards.
#pragma once

#include <pybind11/pybind11.h>

#include "exchange.hpp"
#include "kinesphere/monitor/monitor.hpp"

namespace kinesphere::python {

namespace py = pybind11;

/// Reads a sequence of objects of a bound class; `wanted` is its name for messages, such as "a TrackClass".
template <class Bound>
std::vector<Bound> list_of(const py::object& given, const Argument& argument, const char* wanted) {
  const auto fail = [&](const std::string& name, py::handle found) {
    throw py::type_error(std::string(argument.call) + ": " + name + " must be " + wanted + ", but is " +
                         py::repr(found).cast<std::string>());
  };
  const std::string name(argument.name);
  if (!py::isinstance<py::sequence>(given) || py::isinstance<py::str>(given)) {
    throw py::type_error(std::string(argument.call) + ": " + name + " must be a list, but is " +
                         py::repr(given).cast<std::string>());
  }
  std::vector<Bound> list;
  for (const py::handle item : py::reinterpret_borrow<py::sequence>(given)) {
    if (!py::isinstance<Bound>(item)) fail(name + "[" + std::to_string(list.size()) + "]", item);
    list.push_back(item.cast<Bound>());
  }
  return list;
}

void bind_monitor_definition(py::module_& module);

}  // namespace kinesphere::python
