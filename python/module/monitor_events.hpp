// Events of a monitor as objects of Python, and as rows of a table.
#pragma once

#include <pybind11/pybind11.h>

#include <span>

#include "records.hpp"

namespace kinesphere::python {

namespace py = pybind11;

/// Returns a kinesphere.MonitorEvents.
py::object table_of(std::span<const MonitorEventRecord> records);

void bind_monitor_events(py::module_& module);

}  // namespace kinesphere::python
