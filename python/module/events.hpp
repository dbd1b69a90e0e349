// Events as objects of Python, and as rows of a table.
#pragma once

#include <pybind11/pybind11.h>

#include <span>

#include "records.hpp"

namespace kinesphere::python {

namespace py = pybind11;

/// Returns a kinesphere.Events.
py::object table_of(std::span<const EventRecord> records);

void bind_events(py::module_& module);

}  // namespace kinesphere::python
