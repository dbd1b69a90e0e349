#include "events.hpp"

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

constexpr std::size_t velocity_offset = offsetof(State, velocity);
static_assert(sizeof(EventRecord) == offsetof(EventRecord, unused_at_end) + 2);
constexpr Field event_fields[] = {
    {"kind", "u1", offsetof(EventRecord, kind)},
    {"time", "f8", offsetof(EventRecord, time)},
    {"first", "i8", offsetof(EventRecord, first)},
    {"second", "i8", offsetof(EventRecord, second)},
    {"wall", "u1", offsetof(EventRecord, wall)},
    {"repeated", "?", offsetof(EventRecord, repeated)},
    {"jammed", "?", offsetof(EventRecord, jammed)},
    {"already_touching", "?", offsetof(EventRecord, already_touching)},
    {"senses", "u1", offsetof(EventRecord, senses)},
    {"first_position", "3f8", offsetof(EventRecord, first_state)},
    {"first_velocity", "3f8", offsetof(EventRecord, first_state) + velocity_offset},
    {"second_position", "3f8", offsetof(EventRecord, second_state)},
    {"second_velocity", "3f8", offsetof(EventRecord, second_state) + velocity_offset},
    {"point", "3f8", offsetof(EventRecord, point)},
    {"normal", "3f8", offsetof(EventRecord, normal)},
    {"gap", "f8", offsetof(EventRecord, gap)},
    {"approach_speed", "f8", offsetof(EventRecord, approach_speed)},
    {"position_excess", "f8", offsetof(EventRecord, position_excess)},
    {"velocity_excess", "f8", offsetof(EventRecord, velocity_excess)},
    {"distance", "f8", offsetof(EventRecord, distance)},
    {"first_user_data", "u8", offsetof(EventRecord, first_user_data)},
    {"second_user_data", "u8", offsetof(EventRecord, second_user_data)},
    {"first_mass", "f8", offsetof(EventRecord, first_mass)},
    {"second_mass", "f8", offsetof(EventRecord, second_mass)},
    {"first_part", "u4", offsetof(EventRecord, first_part)},
    {"second_part", "u4", offsetof(EventRecord, second_part)},
    {"first_angular_velocity", "3f8", offsetof(EventRecord, first_angular_velocity)},
    {"second_angular_velocity", "3f8", offsetof(EventRecord, second_angular_velocity)},
    {"first_spin_gain", "3f8", offsetof(EventRecord, first_spin_gain)},
    {"second_spin_gain", "3f8", offsetof(EventRecord, second_spin_gain)},
    {"acceleration_limit", "f8", offsetof(EventRecord, acceleration_limit)},
    {"first_is_static", "?", offsetof(EventRecord, first_is_static)},
    {"first_is_zone", "?", offsetof(EventRecord, first_is_zone)},
    {"first_is_sleeping", "?", offsetof(EventRecord, first_is_sleeping)},
    {"second_is_static", "?", offsetof(EventRecord, second_is_static)},
    {"second_is_zone", "?", offsetof(EventRecord, second_is_zone)},
    {"second_is_sleeping", "?", offsetof(EventRecord, second_is_sleeping)},
};

Event event_of(const EventRecord& record) {
  return {.kind = record.kind,
          .time = record.time,
          .first = BodyId::unpack(static_cast<std::uint64_t>(record.first)),
          .second = BodyId::unpack(static_cast<std::uint64_t>(record.second)),
          .wall = record.wall,
          .repeated = record.repeated,
          .jammed = record.jammed,
          .already_touching = record.already_touching,
          .senses = record.senses,
          .first_traits = {record.first_is_static, record.first_is_zone, record.first_is_sleeping},
          .second_traits = {record.second_is_static, record.second_is_zone, record.second_is_sleeping},
          .first_state = record.first_state,
          .second_state = record.second_state,
          .point = record.point,
          .normal = record.normal,
          .gap = record.gap,
          .approach_speed = record.approach_speed,
          .position_excess = record.position_excess,
          .velocity_excess = record.velocity_excess,
          .distance = record.distance,
          .first_user_data = record.first_user_data,
          .second_user_data = record.second_user_data,
          .first_mass = record.first_mass,
          .second_mass = record.second_mass,
          .first_part = record.first_part,
          .second_part = record.second_part,
          .first_angular_velocity = record.first_angular_velocity,
          .second_angular_velocity = record.second_angular_velocity,
          .first_spin_gain = record.first_spin_gain,
          .second_spin_gain = record.second_spin_gain,
          .acceleration_limit = record.acceleration_limit};
}

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

/// Returns a member of one of the package's enumerations.
py::object member(const char* enumeration, int number) {
  return package_attribute("kinesphere.kinds", enumeration)(number);
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

}  // namespace

EventRecord record_of(const Event& event) {
  return {event.kind,
          {},
          event.time,
          number_of(event.first),
          number_of(event.second),
          event.wall,
          event.repeated,
          event.jammed,
          event.already_touching,
          event.senses,
          {},
          event.first_state,
          event.second_state,
          event.point,
          event.normal,
          event.gap,
          event.approach_speed,
          event.position_excess,
          event.velocity_excess,
          event.distance,
          event.first_user_data,
          event.second_user_data,
          event.first_mass,
          event.second_mass,
          event.first_part,
          event.second_part,
          event.first_angular_velocity,
          event.second_angular_velocity,
          event.first_spin_gain,
          event.second_spin_gain,
          event.acceleration_limit,
          event.first_traits.is_static,
          event.first_traits.is_zone,
          event.first_traits.is_sleeping,
          event.second_traits.is_static,
          event.second_traits.is_zone,
          event.second_traits.is_sleeping,
          {}};
}

py::object table_of(std::span<const EventRecord> records) {
  static const py::handle type = row_type(event_fields, sizeof(EventRecord)).release();
  static const py::handle table = package_attribute("kinesphere.events", "Events").release();
  NewArray array({records.size()}, py::reinterpret_borrow<py::object>(type), sizeof(EventRecord));
  if (!records.empty()) std::memcpy(array.data<EventRecord>(), records.data(), records.size_bytes());
  return table(array.take());
}

void bind_events(py::module_& module) {
  module.attr("event_dtype") = row_type(event_fields, sizeof(EventRecord));
  module.def("event_kind_names", [] { return names_of<EventKind>(event_kind_count); });
  module.def("wall_names", [] { return names_of<Wall>(wall_count + 1); });

  py::class_<Event>(module, "Event", R"(Something that happened, at its exact time.

Positions are lengths, times and speeds in the units of the world; vectors are arrays of shape (3,) that
cannot be changed.)")
      .def_static("_from_record",
                  [](const py::object& record) { return event_of(records_of(record, "Event").at(0)); })
      .def_property_readonly(
          "kind", [](const Event& event) { return member("EventKind", static_cast<int>(event.kind)); })
      .def_readonly("time", &Event::time)
      .def_property_readonly(
          "first", [](const Event& event) { return object_of(event.first); },
          "The body, or the one of the two with the smaller id.")
      .def_property_readonly(
          "second", [](const Event& event) { return object_of(event.second); },
          "The other body; None for wall events, bound violations and bodies that are woken.")
      .def_property_readonly(
          "wall",
          [](const Event& event) -> py::object {
            if (event.wall == Wall::none) return py::none();
            return member("Wall", static_cast<int>(event.wall));
          },
          "The wall of a wall event, else None.")
      .def_readonly(
          "repeated", &Event::repeated,
          "One of the two touched something less than its Zeno interval ago: a response that loses energy "
          "should lose none here.")
      .def_readonly(
          "jammed", &Event::jammed,
          "Each of the two has had 64 contacts at this very instant already, as a ball that is stuck "
          "between others: a response should make them part, or stop both. bounce() and settle() do.")
      .def_readonly("already_touching", &Event::already_touching,
                    "Of begins: the two have touched since an earlier begin, and approach again. To count "
                    "contacts, count the others.")
      .def_property_readonly(
          "senses", [](const Event& event) { return member("Senses", static_cast<int>(event.senses)); },
          "Of sensor events: which of the two senses the other.")
      .def_property_readonly(
          "first_position", [](const Event& event) { return array_of(event.first_state.position); },
          "At `time`, shape (3,). Of a static body one point of its shape.")
      .def_property_readonly("first_velocity",
                             [](const Event& event) { return array_of(event.first_state.velocity); })
      .def_property_readonly(
          "second_position", [](const Event& event) { return array_of(event.second_state.position); },
          "Where space repeats, in the image that is nearest to the first. Zero where there is no second "
          "body.")
      .def_property_readonly("second_velocity",
                             [](const Event& event) { return array_of(event.second_state.velocity); })
      .def_property_readonly(
          "point", [](const Event& event) { return array_of(event.point); },
          "The middle of the gap between the two surfaces, shape (3,).")
      .def_property_readonly(
          "normal", [](const Event& event) { return array_of(event.normal); },
          "Unit vector from the first towards the second, or towards the wall, shape (3,).")
      .def_readonly("gap", &Event::gap, "Distance between the surfaces (length); negative when they overlap.")
      .def_readonly("approach_speed", &Event::approach_speed,
                    "Speed at which the gap closes (length / time); negative when it opens.")
      .def_readonly("position_excess", &Event::position_excess,
                    "Of bound violations: how far the reported position lies outside the bound (length).")
      .def_readonly(
          "velocity_excess", &Event::velocity_excess,
          "Of bound violations: by how much the velocity changed more than promised (length / time).")
      .def_readonly("acceleration_limit", &Event::acceleration_limit,
                    "Of bound violations: the acceleration limit that the body has from now on (length / "
                    "time^2).")
      .def_readonly("distance", &Event::distance,
                    "Of sensor events: the sensor distance that was crossed (length).")
      .def_readonly("first_user_data", &Event::first_user_data)
      .def_readonly("second_user_data", &Event::second_user_data)
      .def_readonly("first_mass", &Event::first_mass, "Of add(); infinite for a static body.")
      .def_readonly("second_mass", &Event::second_mass, "Infinite for a static body and for a wall.")
      .def_readonly(
          "first_part", &Event::first_part,
          "Of a rigid body: the number of the part at the contact; of a Mesh: that of the triangle; 0 for "
          "all others.")
      .def_readonly("second_part", &Event::second_part)
      .def_property_readonly(
          "first_angular_velocity", [](const Event& event) { return array_of(event.first_angular_velocity); },
          "Of a rigid body (radians / time), shape (3,); zero for all others.")
      .def_property_readonly("second_angular_velocity",
                             [](const Event& event) { return array_of(event.second_angular_velocity); })
      .def_property_readonly(
          "first_spin_gain", [](const Event& event) { return array_of(event.first_spin_gain); },
          "Change of the angular velocity of a rigid body by a unit impulse along the normal (radians / "
          "(mass length)), shape (3,).")
      .def_property_readonly("second_spin_gain",
                             [](const Event& event) { return array_of(event.second_spin_gain); })
      .def_property_readonly(
          "first_is_static", [](const Event& event) { return event.first_traits.is_static; },
          "The body never moves (add_static, add_zone).")
      .def_property_readonly(
          "first_is_zone", [](const Event& event) { return event.first_traits.is_zone; },
          "The body is not solid: it touches nobody.")
      .def_property_readonly(
          "first_is_sleeping", [](const Event& event) { return event.first_traits.is_sleeping; },
          "The body sleeps and stays asleep: False for contacts, which wake.")
      .def_property_readonly("second_is_static",
                             [](const Event& event) { return event.second_traits.is_static; })
      .def_property_readonly("second_is_zone", [](const Event& event) { return event.second_traits.is_zone; })
      .def_property_readonly("second_is_sleeping",
                             [](const Event& event) { return event.second_traits.is_sleeping; })
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
