#include "events.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <limits>
#include <string>

#include <pybind11/stl.h>

#include "errors.hpp"
#include "exchange.hpp"
#include "kinesphere/event_hash.hpp"
#include "kinesphere/response.hpp"
#include "moving.hpp"

namespace kinesphere::python {
namespace {

EventRecord record_at(const std::byte* bytes) {
  EventRecord record;
  std::memcpy(&record, bytes, sizeof record);
  return record;
}

/// Precondition: an array of rows with contiguous bytes.
std::vector<EventRecord> records_of(const py::object& given, std::string_view call) {
  const std::vector<std::byte> bytes = bytes_from(given, {call, "events"});
  std::vector<EventRecord> records;
  for (std::size_t at = 0; at + sizeof(EventRecord) <= bytes.size(); at += sizeof(EventRecord))
    records.push_back(record_at(bytes.data() + at));
  return records;
}

py::bytes record_bytes(const Event& event) {
  const EventRecord record = record_of(event);
  return bytes_of(std::as_bytes(std::span(&record, 1)));
}

template <class Kind>
py::list names_of(int count) {
  py::list names;
  for (int k = 0; k < count; ++k) names.append(std::string(name_of(static_cast<Kind>(k))));
  return names;
}

std::string text_of(const Event& event) {
  std::string text = "<Event " + std::string(name_of(event.kind)) + " at " +
                     py::repr(py::float_(event.time)).cast<std::string>() + ": " + to_string(event.first);
  if (event.second != no_body) text += ", " + to_string(event.second);
  if (event.wall != Wall::none) text += ", " + std::string(name_of(event.wall));
  return text + ">";
}

/// Returns a kinesphere.Events of the bytes of EventRecords.
py::object table_of_rows(std::span<const std::byte> rows) {
  static const py::handle type = row_type(event_fields, sizeof(EventRecord)).release();
  static const py::handle table = package_attribute("kinesphere.events", "Events").release();
  NewArray array({rows.size() / sizeof(EventRecord)}, py::reinterpret_borrow<py::object>(type),
                 sizeof(EventRecord));
  if (!rows.empty()) std::memcpy(array.data<std::byte>(), rows.data(), rows.size());
  return table(array.take());
}

/// Returns the bytes of a number or vector of this type of NumPy, such as "f8" or "3f8".
std::size_t size_of(std::string_view type) {
  const std::size_t count = type.size() == 3 ? static_cast<std::size_t>(type.front() - '0') : 1;
  return type == "?" ? 1 : count * static_cast<std::size_t>(type.back() - '0');
}

const Field& column(const std::string& name) {
  const auto found =
      std::ranges::find_if(event_fields, [&](const Field& field) { return field.name == name; });
  if (found != std::end(event_fields)) return *found;
  throw BadResult({ErrorCode::out_of_range, "events", no_body,
                   "run: events must name columns of Event, but there is no " + name});
}

}  // namespace

void KeptEvents::choose(const py::object& events) {
  KeptEvents chosen;
  const bool is_word = py::isinstance<py::str>(events);
  const std::string word = is_word ? events.cast<std::string>() : "";
  chosen.all_ = word == "all";
  if (is_word && word != "all" && word != "none")
    throw BadResult({ErrorCode::out_of_range, "events", no_body,
                     "run: events must be \"all\", \"none\" or a list of columns, but is \"" + word + "\""});
  if (!chosen.all_) {
    chosen.parts_.clear();
    chosen.row_size_ = 0;
    for (const py::handle name : is_word ? py::object(py::tuple()) : events) {
      Field field = column(name.cast<std::string>());
      chosen.parts_.emplace_back(field.offset, size_of(field.type));
      field.offset = std::exchange(chosen.row_size_, chosen.row_size_ + size_of(field.type));
      chosen.columns_.push_back(field);
    }
  }
  if (!rows_.empty() && chosen.parts_ != parts_) {
    throw BadResult(
        {ErrorCode::run_in_progress, "events", no_body,
         "run: events must be as in the run that was interrupted, whose events come first, but are others"});
  }
  chosen.rows_ = std::move(rows_);
  *this = std::move(chosen);
}

void KeptEvents::add(const EventRecord& record) {
  const auto* const bytes = reinterpret_cast<const std::byte*>(&record);
  for (const auto& [offset, size] : parts_) rows_.insert(rows_.end(), bytes + offset, bytes + offset + size);
}

py::object KeptEvents::take() {
  const std::vector<std::byte> rows = std::exchange(rows_, {});
  if (all_) return table_of_rows(rows);
  if (columns_.empty()) return table_of({});
  NewArray array({rows.size() / row_size_}, row_type(columns_, row_size_), row_size_);
  if (!rows.empty()) std::memcpy(array.data<std::byte>(), rows.data(), rows.size());
  return array.take();
}

py::object table_of(std::span<const EventRecord> records) { return table_of_rows(std::as_bytes(records)); }

void bind_events(py::module_& module) {
  module.attr("event_dtype") = row_type(event_fields, sizeof(EventRecord));
  module.def("event_kind_names", [] { return names_of<EventKind>(event_kind_count); });
  module.def("wall_names", [] { return names_of<Wall>(wall_count + 1); });

  py::class_<Event> bound(module, "Event", R"(Something that happened, at its exact time.

Positions are lengths, times and speeds in the units of the world; vectors are arrays of shape (3,) that
cannot be changed.)");
  each_event_property(
      [&](const char* name, auto get, const char* doc) { bound.def_property_readonly(name, get, doc); });
  bound
      .def_static("_from_record",
                  [](const py::object& record) { return event_of(records_of(record, "Event").at(0)); })
      .def(
          "partner_of",
          [](const Event& event, const py::object& body) {
            return object_of(event.partner_of(id_of(body, {"partner_of", "body"})));
          },
          py::arg("body"), "The other body of the pair; None if there is none, or body has no part.")
      .def(
          "is_sensed_by",
          [](const Event& event, const py::object& body) {
            return event.is_sensed_by(id_of(body, {"is_sensed_by", "body"}));
          },
          py::arg("body"), "Of sensor events: whether this body senses the other, which may sense it, too.")
      .def_property_readonly(
          "sensor", [](const Event& event) { return object_of(event.sensor()); },
          "Of sensor events: the body that senses (the first where both do), else None.")
      .def_property_readonly(
          "visitor", [](const Event& event) { return object_of(event.visitor()); },
          "Of sensor events: the body that is sensed, else None.")
      .def("__eq__",
           [](const Event& a, const py::object& b) {
             return py::isinstance<Event>(b) && record_bytes(a).equal(record_bytes(b.cast<const Event&>()));
           })
      .def("__hash__", [](const Event& event) { return py::hash(record_bytes(event)); })
      .def("_to_record", record_bytes)
      .def("__repr__", text_of)
      .def(py::pickle(&record_bytes,
                      [](const py::bytes& state) { return event_of(records_of(state, "Event").at(0)); }));

  py::class_<EventHash>(module, "EventHash", R"(One number for all events of a run.

Two runs with the same number went the same way, to the last bit: any bit of a time, kind, id, wall or
sensor distance that differs changes it. str(hash) has the 16 digits that the program `kinesphere` prints.)")
      .def(py::init<>())
      .def(
          "add",
          [](py::object self, const py::object& events) {
            auto& hash = self.cast<EventHash&>();
            if (py::isinstance<Event>(events)) {
              hash.add(events.cast<const Event&>());
            } else {
              const py::object rows = numpy("ascontiguousarray")(events.attr("array"));
              for (const EventRecord& record : records_of(rows.attr("view")("u1"), "EventHash.add"))
                hash.add(event_of(record));
            }
            return self;
          },
          py::arg("events"), "Adds an Event or Events. Returns the hash itself.")
      .def("__iadd__", [](EventHash& hash, const EventHash& other) { return hash += other; })
      .def_property_readonly("value", &EventHash::value, "64 bits.")
      .def_property_readonly("count", [](const EventHash& hash) { return hash.parts()[1]; })
      .def("__eq__", [](const EventHash& a, const EventHash& b) { return a.parts() == b.parts(); })
      .def("__str__", [](const EventHash& hash) { return py::str("{:016x}").format(hash.value()); })
      .def("__repr__",
           [](const EventHash& hash) { return py::str("<EventHash {:016x}>").format(hash.value()); })
      .def(
          py::pickle([](const EventHash& hash) { return py::make_tuple(hash.parts()[0], hash.parts()[1]); },
                     [](const py::tuple& parts) {
                       return EventHash::of({parts[0].cast<std::uint64_t>(), parts[1].cast<std::uint64_t>()});
                     }));

  const auto velocities = [](const Event& contact, const Bounce& after) {
    const py::object second = contact.second == no_body ? py::none() : array_of(after.second_velocity);
    return py::make_tuple(array_of(after.first_velocity), second);
  };
  // A restitution that is not named would be a mass.
  const auto require_both = [](std::string_view call, const std::optional<double>& first_mass,
                               const std::optional<double>& second_mass) {
    if (first_mass.has_value() != second_mass.has_value())
      refuse({call, first_mass ? "second_mass" : "first_mass"},
             "must be given with the other mass (a restitution needs its name, as restitution=0.5)",
             "is None");
  };
  module.def(
      "bounce",
      [velocities, require_both](const Event& contact, std::optional<double> first_mass,
                                 std::optional<double> second_mass, double restitution) {
        require_both("bounce", first_mass, second_mass);
        require_bounce("bounce", restitution);
        return velocities(contact, bounce(contact, first_mass.value_or(contact.first_mass),
                                          second_mass.value_or(contact.second_mass), restitution));
      },
      py::arg("contact"), py::arg("first_mass") = py::none(), py::arg("second_mass") = py::none(),
      py::arg("restitution") = 1.0,
      R"(Velocities after a frictionless central bounce: two arrays of shape (3,); at a wall the second is
None.

Masses are > 0, both or none; those of the event if not given. A static body keeps its velocity and turns the other one, as a
wall does; so does a body of infinite mass. The restitution lies in [0, 1]. Momentum is conserved; a repeated
contact loses no energy.)");
  module.def(
      "settle",
      [velocities, require_both](const Event& contact, std::optional<double> first_mass,
                                 std::optional<double> second_mass, double restitution,
                                 double resting_speed) {
        require_both("settle", first_mass, second_mass);
        require_bounce("settle", restitution, resting_speed);
        return velocities(contact,
                          settle(contact, first_mass.value_or(contact.first_mass),
                                 second_mass.value_or(contact.second_mass), restitution, resting_speed));
      },
      py::arg("contact"), py::arg("first_mass"), py::arg("second_mass"), py::arg("restitution"),
      py::arg("resting_speed"),
      R"(As bounce(), for bodies that come to rest in a heap: a repeated contact loses energy too, but no
two leave each other more slowly than with resting_speed (length / time, > 0) or than they came.)");
  module.def("least_resting_speed", least_resting_speed, py::arg("contact_tolerance"),
             py::arg("acceleration"),
             "sqrt(3 tolerance acceleration): the least resting speed for which heaps do not sink into the "
             "tolerance.");
}

}  // namespace kinesphere::python
