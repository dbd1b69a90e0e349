// Events of a monitor as objects of Python, and as rows of a table.
#pragma once

#include <pybind11/pybind11.h>

#include <cstdint>
#include <span>

#include "kinesphere/monitor/monitor_event.hpp"

namespace kinesphere::python {

namespace py = pybind11;

/// A row of kinesphere.monitor_event_dtype.
struct MonitorEventRecord {
  double time;
  TrackId first;
  TrackId second;
  std::uint8_t kind;
  std::uint8_t verdict;
  std::uint8_t before;
  std::uint8_t unused;
  std::uint32_t level;
  double since;
  double likely_time;
  double closest_time;
  double closest_distance;
  double position_excess;
  double velocity_excess;
};
MonitorEventRecord record_of(const MonitorEvent& event);

/// Returns a kinesphere.MonitorEvents.
py::object table_of(std::span<const MonitorEventRecord> records);

/// Returns the member of kinesphere.Verdict.
py::object object_of(Verdict verdict);

void bind_monitor_events(py::module_& module);

}  // namespace kinesphere::python
