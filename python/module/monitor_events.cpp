#include "monitor_events.hpp"

#include <cstddef>
#include <cstring>
#include <string>

#include "exchange.hpp"

namespace kinesphere::python {
namespace {

// In the order of their offsets, which numpy.save() requires.
constexpr Field monitor_event_fields[] = {
    {"time", "f8", offsetof(MonitorEventRecord, time)},
    {"first", "u8", offsetof(MonitorEventRecord, first)},
    {"second", "u8", offsetof(MonitorEventRecord, second)},
    {"kind", "u1", offsetof(MonitorEventRecord, kind)},
    {"verdict", "u1", offsetof(MonitorEventRecord, verdict)},
    {"before", "u1", offsetof(MonitorEventRecord, before)},
    {"level", "u4", offsetof(MonitorEventRecord, level)},
    {"since", "f8", offsetof(MonitorEventRecord, since)},
    {"likely_time", "f8", offsetof(MonitorEventRecord, likely_time)},
    {"closest_time", "f8", offsetof(MonitorEventRecord, closest_time)},
    {"closest_distance", "f8", offsetof(MonitorEventRecord, closest_distance)},
    {"position_excess", "f8", offsetof(MonitorEventRecord, position_excess)},
    {"velocity_excess", "f8", offsetof(MonitorEventRecord, velocity_excess)},
};

MonitorEvent monitor_event_of(const py::object& given) {
  const std::vector<std::byte> bytes = bytes_from(given, {"MonitorEvent", "record"});
  MonitorEventRecord record{};
  if (bytes.size() != sizeof record)
    refuse({"MonitorEvent", "record"}, "must have " + std::to_string(sizeof record) + " bytes",
           "has " + std::to_string(bytes.size()));
  std::memcpy(&record, bytes.data(), sizeof record);
  return {.time = record.time,
          .kind = static_cast<MonitorEventKind>(record.kind),
          .first = record.first,
          .second = record.second,
          .level = record.level,
          .verdict = static_cast<Verdict>(record.verdict),
          .before = static_cast<Verdict>(record.before),
          .since = record.since,
          .likely_time = record.likely_time,
          .closest_time = record.closest_time,
          .closest_distance = record.closest_distance,
          .position_excess = record.position_excess,
          .velocity_excess = record.velocity_excess};
}

py::bytes bytes_of_event(const MonitorEvent& event) {
  const MonitorEventRecord record = record_of(event);
  return bytes_of(std::as_bytes(std::span(&record, 1)));
}

py::object kind_of(const MonitorEvent& event) {
  return package_attribute("kinesphere.kinds", "MonitorEventKind")(static_cast<int>(event.kind));
}

py::object verdict_or_none(const MonitorEvent& event, Verdict verdict) {
  return event.kind == MonitorEventKind::verdict ? object_of(verdict) : py::none();
}

std::string monitor_event_text(const MonitorEvent& event) {
  std::string text = "<MonitorEvent " + py::str(kind_of(event)).cast<std::string>() + " at " +
                     py::repr(py::float_(event.time)).cast<std::string>() + ": " +
                     std::to_string(event.first);
  if (is_of_pair(event.kind))
    text += ", " + std::to_string(event.second) + ", level " + std::to_string(event.level);
  if (event.kind == MonitorEventKind::verdict) text += ", " + std::string(name_of(event.verdict));
  return text + ">";
}

}  // namespace

py::object object_of(Verdict verdict) {
  return package_attribute("kinesphere.kinds", "Verdict")(static_cast<int>(verdict));
}

MonitorEventRecord record_of(const MonitorEvent& event) {
  return {event.time,
          event.first,
          event.second,
          static_cast<std::uint8_t>(event.kind),
          static_cast<std::uint8_t>(event.verdict),
          static_cast<std::uint8_t>(event.before),
          0,
          event.level,
          event.since,
          event.likely_time,
          event.closest_time,
          event.closest_distance,
          event.position_excess,
          event.velocity_excess};
}

py::object table_of(std::span<const MonitorEventRecord> records) {
  static const py::handle type = row_type(monitor_event_fields, sizeof(MonitorEventRecord)).release();
  static const py::handle table = package_attribute("kinesphere.events", "MonitorEvents").release();
  NewArray array({records.size()}, py::reinterpret_borrow<py::object>(type), sizeof(MonitorEventRecord));
  if (!records.empty()) std::memcpy(array.data<MonitorEventRecord>(), records.data(), records.size_bytes());
  return table(array.take());
}

void bind_monitor_events(py::module_& module) {
  module.attr("monitor_event_dtype") = row_type(monitor_event_fields, sizeof(MonitorEventRecord));
  py::class_<MonitorEvent>(module, "MonitorEvent", "Something that a monitor found out, at its exact time.")
      .def_static("_from_record", monitor_event_of)
      .def("_to_record", bytes_of_event)
      .def_readonly("time", &MonitorEvent::time)
      .def_property_readonly("kind", kind_of)
      .def_readonly("first", &MonitorEvent::first, "The track; for a pair, the one with the lower id.")
      .def_property_readonly(
          "second",
          [](const MonitorEvent& event) -> py::object {
            return is_of_pair(event.kind) ? py::object(py::int_(event.second)) : py::none();
          },
          "The track with the higher id; None for events of one track.")
      .def_readonly("level", &MonitorEvent::level, "For a verdict or a prediction: the separation level.")
      .def_property_readonly(
          "verdict", [](const MonitorEvent& event) { return verdict_or_none(event, event.verdict); },
          "The new Verdict; None for other kinds.")
      .def_property_readonly(
          "before", [](const MonitorEvent& event) { return verdict_or_none(event, event.before); },
          "The previous Verdict.")
      .def_readonly("since", &MonitorEvent::since,
                    "When the previous verdict, or the prediction, began; -inf if the pair was apart at all "
                    "levels.")
      .def_readonly("likely_time", &MonitorEvent::likely_time,
                    "For a prediction: when the two come within the separation, if both go straight on; inf "
                    "if they do not.")
      .def_readonly("closest_time", &MonitorEvent::closest_time,
                    "For a prediction: the time of their closest approach.")
      .def_readonly(
          "closest_distance", &MonitorEvent::closest_distance,
          "For a prediction: their distance at that time (length); for a cylinder, that in the plane.")
      .def_readonly("position_excess", &MonitorEvent::position_excess,
                    "For a contradiction: how far outside of what was possible the position is (length).")
      .def_readonly("velocity_excess", &MonitorEvent::velocity_excess,
                    "For a contradiction: the same of the velocity (length / time).")
      .def(
          "__eq__", [](const MonitorEvent& a, const MonitorEvent& b) { return a == b; }, py::is_operator())
      .def("__repr__", monitor_event_text)
      .def(py::pickle(&bytes_of_event, [](const py::bytes& state) { return monitor_event_of(state); }));
}

}  // namespace kinesphere::python
