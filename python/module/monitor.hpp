// A monitor as Python has it.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "guard.hpp"
#include "kinesphere/monitor/monitor.hpp"
#include "records.hpp"

namespace kinesphere::python {

namespace py = pybind11;

/// Returns a kinesphere.MonitorEvents.
py::object table_of(std::span<const MonitorEventRecord> records);
void bind_monitor_events(py::module_& module);

struct MonitorHandle {
  explicit MonitorHandle(Monitor made) : monitor(std::move(made)) {}

  Monitor monitor;
  InUse in_use{};
  /// Events that an interrupted call has taken from the monitor.
  std::vector<MonitorEventRecord> undelivered{};

  bool is_plane() const { return monitor.definition().dimensions == 2; }
  InUse::Use take(std::string_view call) { return in_use.take(call, "monitor"); }
};

using MonitorClass = py::class_<MonitorHandle, std::shared_ptr<MonitorHandle>>;

// Each function binds the calls of one subject.
void bind_monitor(py::module_& module);
void bind_monitor_answers(py::module_& module, MonitorClass& monitor);

}  // namespace kinesphere::python
