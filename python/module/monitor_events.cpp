#include "monitor.hpp"

#include <cstddef>
#include <cstring>
#include <string>

#include "exchange.hpp"

namespace kinesphere::python {
namespace {

MonitorEvent event_of_bytes(const py::object& given) {
  const std::vector<std::byte> bytes = bytes_from(given, {"MonitorEvent", "record"});
  MonitorEventRecord record{};
  if (bytes.size() != sizeof record)
    refuse({"MonitorEvent", "record"}, "must have " + std::to_string(sizeof record) + " bytes",
           "has " + std::to_string(bytes.size()));
  std::memcpy(&record, bytes.data(), sizeof record);
  return monitor_event_of(record);
}

py::bytes bytes_of_event(const MonitorEvent& event) {
  const MonitorEventRecord record = record_of(event);
  return bytes_of(std::as_bytes(std::span(&record, 1)));
}

py::object verdict_or_none(const MonitorEvent& event, Verdict verdict) {
  return event.kind == MonitorEventKind::verdict ? object_of_field(verdict) : py::none();
}

std::string monitor_event_text(const MonitorEvent& event) {
  std::string text = "<MonitorEvent " + std::string(name_of(event.kind)) + " at " +
                     py::repr(py::float_(event.time)).cast<std::string>() + ": " +
                     std::to_string(event.first);
  if (is_of_pair(event.kind))
    text += ", " + std::to_string(event.second) + ", level " + std::to_string(event.level);
  if (event.kind == MonitorEventKind::verdict) text += ", " + std::string(name_of(event.verdict));
  return text + ">";
}

}  // namespace

py::object table_of(std::span<const MonitorEventRecord> records) {
  static const py::handle type = row_type(monitor_event_fields, sizeof(MonitorEventRecord)).release();
  static const py::handle table = package_attribute("kinesphere.events", "MonitorEvents").release();
  NewArray array({records.size()}, py::reinterpret_borrow<py::object>(type), sizeof(MonitorEventRecord));
  if (!records.empty()) std::memcpy(array.data<MonitorEventRecord>(), records.data(), records.size_bytes());
  return table(array.take());
}

void bind_monitor_events(py::module_& module) {
  module.attr("monitor_event_dtype") = row_type(monitor_event_fields, sizeof(MonitorEventRecord));
  py::class_<MonitorEvent> bound(module, "MonitorEvent",
                                 "Something that a monitor found out, at its exact time.");
  each_monitor_event_property(
      [&](const char* name, auto get, const char* doc) { bound.def_property_readonly(name, get, doc); });
  bound.def_static("_from_record", event_of_bytes)
      .def("_to_record", bytes_of_event)
      .def_property_readonly(
          "second",
          [](const MonitorEvent& event) -> py::object {
            return is_of_pair(event.kind) ? py::object(py::int_(event.second)) : py::none();
          },
          "The track with the higher id; None for events of one track.")
      .def_property_readonly(
          "verdict", [](const MonitorEvent& event) { return verdict_or_none(event, event.verdict); },
          "The new Verdict; None for other kinds.")
      .def_property_readonly(
          "before", [](const MonitorEvent& event) { return verdict_or_none(event, event.before); },
          "The previous Verdict.")
      .def(
          "__eq__", [](const MonitorEvent& a, const MonitorEvent& b) { return a == b; }, py::is_operator())
      .def("__repr__", monitor_event_text)
      .def(py::pickle(&bytes_of_event, [](const py::bytes& state) { return event_of_bytes(state); }));
}

}  // namespace kinesphere::python
