// Generated from include/kinesphere.h by interface/generate.py: change the header, and run that.
// Rows of tables, and properties of objects.
// clang-format off
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "exchange.hpp"
#include "kinesphere/event.hpp"
#include "kinesphere/monitor/monitor.hpp"
#include "kinesphere/monitor/monitor_event.hpp"

namespace kinesphere::python {

/// A row of a table; bytes that are not used are zero, as they go into files.
struct EventRecord {
  std::uint8_t kind;
  std::array<std::uint8_t, 7> unused_1;
  double time;
  std::int64_t first;
  std::int64_t second;
  std::uint8_t wall;
  bool repeated;
  bool jammed;
  bool already_touching;
  std::uint8_t senses;
  std::array<std::uint8_t, 3> unused_2;
  std::int32_t pair_state;
  std::array<std::uint8_t, 4> unused_3;
  Vec3 first_position;
  Vec3 first_velocity;
  Vec3 second_position;
  Vec3 second_velocity;
  Vec3 point;
  Vec3 normal;
  double gap;
  double approach_speed;
  double position_excess;
  double velocity_excess;
  double distance;
  std::uint64_t first_user_data;
  std::uint64_t second_user_data;
  double first_mass;
  double second_mass;
  std::uint32_t first_part;
  std::uint32_t second_part;
  Vec3 first_angular_velocity;
  Vec3 second_angular_velocity;
  Vec3 first_spin_gain;
  Vec3 second_spin_gain;
  double acceleration_limit;
  bool first_is_static;
  bool first_is_zone;
  bool first_is_sleeping;
  bool second_is_static;
  bool second_is_zone;
  bool second_is_sleeping;
  std::array<std::uint8_t, 2> unused_at_end;
};
static_assert(sizeof(EventRecord) == 384);
inline constexpr Field event_fields[] = {
    {"kind", "u1", offsetof(EventRecord, kind)},
    {"time", "f8", offsetof(EventRecord, time)},
    {"first", "i8", offsetof(EventRecord, first)},
    {"second", "i8", offsetof(EventRecord, second)},
    {"wall", "u1", offsetof(EventRecord, wall)},
    {"repeated", "?", offsetof(EventRecord, repeated)},
    {"jammed", "?", offsetof(EventRecord, jammed)},
    {"already_touching", "?", offsetof(EventRecord, already_touching)},
    {"senses", "u1", offsetof(EventRecord, senses)},
    {"pair_state", "i4", offsetof(EventRecord, pair_state)},
    {"first_position", "3f8", offsetof(EventRecord, first_position)},
    {"first_velocity", "3f8", offsetof(EventRecord, first_velocity)},
    {"second_position", "3f8", offsetof(EventRecord, second_position)},
    {"second_velocity", "3f8", offsetof(EventRecord, second_velocity)},
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
inline EventRecord record_of(const Event& from) {
  EventRecord to{};
  to.kind = static_cast<std::uint8_t>(from.kind);
  to.time = from.time;
  to.first = number_of(from.first);
  to.second = number_of(from.second);
  to.wall = static_cast<std::uint8_t>(from.wall);
  to.repeated = from.repeated;
  to.jammed = from.jammed;
  to.already_touching = from.already_touching;
  to.senses = static_cast<std::uint8_t>(from.senses);
  to.pair_state = from.pair_state;
  to.first_position = from.first_state.position;
  to.first_velocity = from.first_state.velocity;
  to.second_position = from.second_state.position;
  to.second_velocity = from.second_state.velocity;
  to.point = from.point;
  to.normal = from.normal;
  to.gap = from.gap;
  to.approach_speed = from.approach_speed;
  to.position_excess = from.position_excess;
  to.velocity_excess = from.velocity_excess;
  to.distance = from.distance;
  to.first_user_data = from.first_user_data;
  to.second_user_data = from.second_user_data;
  to.first_mass = from.first_mass;
  to.second_mass = from.second_mass;
  to.first_part = from.first_part;
  to.second_part = from.second_part;
  to.first_angular_velocity = from.first_angular_velocity;
  to.second_angular_velocity = from.second_angular_velocity;
  to.first_spin_gain = from.first_spin_gain;
  to.second_spin_gain = from.second_spin_gain;
  to.acceleration_limit = from.acceleration_limit;
  to.first_is_static = from.first_traits.is_static;
  to.first_is_zone = from.first_traits.is_zone;
  to.first_is_sleeping = from.first_traits.is_sleeping;
  to.second_is_static = from.second_traits.is_static;
  to.second_is_zone = from.second_traits.is_zone;
  to.second_is_sleeping = from.second_traits.is_sleeping;
  return to;
}
inline Event event_of(const EventRecord& from) {
  Event to;
  to.kind = static_cast<decltype(to.kind)>(from.kind);
  to.time = from.time;
  to.first = BodyId::unpack(static_cast<std::uint64_t>(from.first));
  to.second = BodyId::unpack(static_cast<std::uint64_t>(from.second));
  to.wall = static_cast<decltype(to.wall)>(from.wall);
  to.repeated = from.repeated;
  to.jammed = from.jammed;
  to.already_touching = from.already_touching;
  to.senses = static_cast<decltype(to.senses)>(from.senses);
  to.pair_state = from.pair_state;
  to.first_state.position = from.first_position;
  to.first_state.velocity = from.first_velocity;
  to.second_state.position = from.second_position;
  to.second_state.velocity = from.second_velocity;
  to.point = from.point;
  to.normal = from.normal;
  to.gap = from.gap;
  to.approach_speed = from.approach_speed;
  to.position_excess = from.position_excess;
  to.velocity_excess = from.velocity_excess;
  to.distance = from.distance;
  to.first_user_data = from.first_user_data;
  to.second_user_data = from.second_user_data;
  to.first_mass = from.first_mass;
  to.second_mass = from.second_mass;
  to.first_part = from.first_part;
  to.second_part = from.second_part;
  to.first_angular_velocity = from.first_angular_velocity;
  to.second_angular_velocity = from.second_angular_velocity;
  to.first_spin_gain = from.first_spin_gain;
  to.second_spin_gain = from.second_spin_gain;
  to.acceleration_limit = from.acceleration_limit;
  to.first_traits.is_static = from.first_is_static;
  to.first_traits.is_zone = from.first_is_zone;
  to.first_traits.is_sleeping = from.first_is_sleeping;
  to.second_traits.is_static = from.second_is_static;
  to.second_traits.is_zone = from.second_is_zone;
  to.second_traits.is_sleeping = from.second_is_sleeping;
  return to;
}

/// A row of a table; bytes that are not used are zero, as they go into files.
struct MonitorEventRecord {
  double time;
  std::uint64_t first;
  std::uint64_t second;
  std::uint8_t kind;
  std::uint8_t verdict;
  std::uint8_t before;
  std::array<std::uint8_t, 1> unused_1;
  std::uint32_t level;
  double since;
  double likely_time;
  double closest_time;
  double closest_distance;
  double position_excess;
  double velocity_excess;
};
static_assert(sizeof(MonitorEventRecord) == 80);
inline constexpr Field monitor_event_fields[] = {
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
inline MonitorEventRecord record_of(const MonitorEvent& from) {
  MonitorEventRecord to{};
  to.time = from.time;
  to.first = from.first;
  to.second = from.second;
  to.kind = static_cast<std::uint8_t>(from.kind);
  to.verdict = static_cast<std::uint8_t>(from.verdict);
  to.before = static_cast<std::uint8_t>(from.before);
  to.level = from.level;
  to.since = from.since;
  to.likely_time = from.likely_time;
  to.closest_time = from.closest_time;
  to.closest_distance = from.closest_distance;
  to.position_excess = from.position_excess;
  to.velocity_excess = from.velocity_excess;
  return to;
}
inline MonitorEvent monitor_event_of(const MonitorEventRecord& from) {
  MonitorEvent to;
  to.time = from.time;
  to.first = from.first;
  to.second = from.second;
  to.kind = static_cast<decltype(to.kind)>(from.kind);
  to.verdict = static_cast<decltype(to.verdict)>(from.verdict);
  to.before = static_cast<decltype(to.before)>(from.before);
  to.level = from.level;
  to.since = from.since;
  to.likely_time = from.likely_time;
  to.closest_time = from.closest_time;
  to.closest_distance = from.closest_distance;
  to.position_excess = from.position_excess;
  to.velocity_excess = from.velocity_excess;
  return to;
}

/// A row of a table; bytes that are not used are zero, as they go into files.
struct PairAnswerRecord {
  std::uint64_t first;
  std::uint64_t second;
  std::uint8_t verdict;
  bool predicted;
  std::array<std::uint8_t, 6> unused_1;
  double since;
  double until;
  double lower;
  double upper;
  double closest_distance;
  double closest_time;
  double closest_horizontal;
  double closest_vertical;
  double relative_speed;
  double likely_time;
  double inevitable_by;
  double avoidable_until;
  std::uint64_t ask;
  double ask_by;
};
static_assert(sizeof(PairAnswerRecord) == 136);
inline constexpr Field pair_answer_fields[] = {
    {"first", "u8", offsetof(PairAnswerRecord, first)},
    {"second", "u8", offsetof(PairAnswerRecord, second)},
    {"verdict", "u1", offsetof(PairAnswerRecord, verdict)},
    {"predicted", "?", offsetof(PairAnswerRecord, predicted)},
    {"since", "f8", offsetof(PairAnswerRecord, since)},
    {"until", "f8", offsetof(PairAnswerRecord, until)},
    {"lower", "f8", offsetof(PairAnswerRecord, lower)},
    {"upper", "f8", offsetof(PairAnswerRecord, upper)},
    {"closest_distance", "f8", offsetof(PairAnswerRecord, closest_distance)},
    {"closest_time", "f8", offsetof(PairAnswerRecord, closest_time)},
    {"closest_horizontal", "f8", offsetof(PairAnswerRecord, closest_horizontal)},
    {"closest_vertical", "f8", offsetof(PairAnswerRecord, closest_vertical)},
    {"relative_speed", "f8", offsetof(PairAnswerRecord, relative_speed)},
    {"likely_time", "f8", offsetof(PairAnswerRecord, likely_time)},
    {"inevitable_by", "f8", offsetof(PairAnswerRecord, inevitable_by)},
    {"avoidable_until", "f8", offsetof(PairAnswerRecord, avoidable_until)},
    {"ask", "u8", offsetof(PairAnswerRecord, ask)},
    {"ask_by", "f8", offsetof(PairAnswerRecord, ask_by)},
};
inline PairAnswerRecord record_of(const PairAnswer& from) {
  PairAnswerRecord to{};
  to.verdict = static_cast<std::uint8_t>(from.verdict);
  to.predicted = from.predicted;
  to.since = from.since;
  to.until = from.until;
  to.lower = from.lower;
  to.upper = from.upper;
  to.closest_distance = from.closest_distance;
  to.closest_time = from.closest_time;
  to.closest_horizontal = from.closest_horizontal;
  to.closest_vertical = from.closest_vertical;
  to.relative_speed = from.relative_speed;
  to.likely_time = from.likely_time;
  to.inevitable_by = from.inevitable_by;
  to.avoidable_until = from.avoidable_until;
  to.ask = from.ask;
  to.ask_by = from.ask_by;
  return to;
}

/// A row of a table; bytes that are not used are zero, as they go into files.
struct OpenPairRecord {
  std::uint64_t first;
  std::uint64_t second;
  std::uint32_t level;
  std::uint8_t verdict;
  std::array<std::uint8_t, 3> unused_1;
  double since;
};
static_assert(sizeof(OpenPairRecord) == 32);
inline constexpr Field open_pair_fields[] = {
    {"first", "u8", offsetof(OpenPairRecord, first)},
    {"second", "u8", offsetof(OpenPairRecord, second)},
    {"level", "u4", offsetof(OpenPairRecord, level)},
    {"verdict", "u1", offsetof(OpenPairRecord, verdict)},
    {"since", "f8", offsetof(OpenPairRecord, since)},
};
inline OpenPairRecord record_of(const OpenPair& from) {
  OpenPairRecord to{};
  to.first = from.first;
  to.second = from.second;
  to.level = from.level;
  to.verdict = static_cast<std::uint8_t>(from.verdict);
  to.since = from.since;
  return to;
}

/// A row of a table; bytes that are not used are zero, as they go into files.
struct PredictedPairRecord {
  std::uint64_t first;
  std::uint64_t second;
  std::uint32_t level;
  std::array<std::uint8_t, 4> unused_1;
  double since;
  double likely_time;
  double closest_time;
  double closest_distance;
};
static_assert(sizeof(PredictedPairRecord) == 56);
inline constexpr Field predicted_pair_fields[] = {
    {"first", "u8", offsetof(PredictedPairRecord, first)},
    {"second", "u8", offsetof(PredictedPairRecord, second)},
    {"level", "u4", offsetof(PredictedPairRecord, level)},
    {"since", "f8", offsetof(PredictedPairRecord, since)},
    {"likely_time", "f8", offsetof(PredictedPairRecord, likely_time)},
    {"closest_time", "f8", offsetof(PredictedPairRecord, closest_time)},
    {"closest_distance", "f8", offsetof(PredictedPairRecord, closest_distance)},
};
inline PredictedPairRecord record_of(const PredictedPair& from) {
  PredictedPairRecord to{};
  to.first = from.first;
  to.second = from.second;
  to.level = from.level;
  to.since = from.since;
  to.likely_time = from.likely_time;
  to.closest_time = from.closest_time;
  to.closest_distance = from.closest_distance;
  return to;
}

/// A row of a table; bytes that are not used are zero, as they go into files.
struct ReportRequestRecord {
  std::uint64_t track;
  double by;
  std::uint64_t other;
};
static_assert(sizeof(ReportRequestRecord) == 24);
inline constexpr Field report_request_fields[] = {
    {"track", "u8", offsetof(ReportRequestRecord, track)},
    {"by", "f8", offsetof(ReportRequestRecord, by)},
    {"other", "u8", offsetof(ReportRequestRecord, other)},
};
inline ReportRequestRecord record_of(const ReportRequest& from) {
  ReportRequestRecord to{};
  to.track = from.track;
  to.by = from.by;
  to.other = from.other;
  return to;
}

/// Calls visit("name", function of an object, "documentation") for each property.
template <class Visit>
void each_event_property(const Visit& visit) {
  visit("kind", [](const Event& from) { return object_of_field(from.kind); },
        "");
  visit("time", [](const Event& from) { return from.time; },
        "");
  visit("first", [](const Event& from) { return object_of_field(from.first); },
        "The body of the event or, for a pair, the body with the smaller id. A timer has none.");
  visit("second", [](const Event& from) { return object_of_field(from.second); },
        "The other body of a pair; None for walls, bound violations, timers and bodies that woke.");
  visit("wall", [](const Event& from) { return object_of_field(from.wall); },
        "The wall of a wall event.");
  visit("repeated", [](const Event& from) { return from.repeated; },
        "One of the two touched another body less than the Zeno interval ago: a response should take no energy here.");
  visit("jammed", [](const Event& from) { return from.jammed; },
        "Each of the two has had 64 contacts at this instant, as if stuck: a response should part them, or stop both.");
  visit("already_touching", [](const Event& from) { return from.already_touching; },
        "Of begins: the two have touched since an earlier begin, and approach again. To count contacts, count the others.");
  visit("senses", [](const Event& from) { return object_of_field(from.senses); },
        "Of sensors: the body or bodies that sense the other one.");
  visit("first_is_static", [](const Event& from) { return from.first_traits.is_static; },
        "The body never moves.");
  visit("first_is_zone", [](const Event& from) { return from.first_traits.is_zone; },
        "The body is not solid: it touches no other body.");
  visit("first_is_sleeping", [](const Event& from) { return from.first_traits.is_sleeping; },
        "The body sleeps and stays asleep: contacts wake their bodies.");
  visit("second_is_static", [](const Event& from) { return from.second_traits.is_static; },
        "The body never moves.");
  visit("second_is_zone", [](const Event& from) { return from.second_traits.is_zone; },
        "The body is not solid: it touches no other body.");
  visit("second_is_sleeping", [](const Event& from) { return from.second_traits.is_sleeping; },
        "The body sleeps and stays asleep: contacts wake their bodies.");
  visit("pair_state", [](const Event& from) { return from.pair_state; },
        "The state that the two of a pair were given; 0 for all others.");
  visit("first_position", [](const Event& from) { return object_of_field(from.first_state.position); },
        "At `time`; of a static body one point of its shape. In periodic space the two are nearest images.");
  visit("first_velocity", [](const Event& from) { return object_of_field(from.first_state.velocity); },
        "At `time`; of a static body one point of its shape. In periodic space the two are nearest images.");
  visit("second_position", [](const Event& from) { return object_of_field(from.second_state.position); },
        "");
  visit("second_velocity", [](const Event& from) { return object_of_field(from.second_state.velocity); },
        "");
  visit("point", [](const Event& from) { return object_of_field(from.point); },
        "The middle of the gap between the two surfaces.");
  visit("normal", [](const Event& from) { return object_of_field(from.normal); },
        "Unit vector from `first` towards `second`, or towards the wall.");
  visit("gap", [](const Event& from) { return from.gap; },
        "Distance between the surfaces (length); negative when they overlap.");
  visit("approach_speed", [](const Event& from) { return from.approach_speed; },
        "Speed at which the gap closes (length / time); negative when it opens.");
  visit("position_excess", [](const Event& from) { return from.position_excess; },
        "Of a bound violation: how far the reported position lies outside the bound (length).");
  visit("velocity_excess", [](const Event& from) { return from.velocity_excess; },
        "Of a bound violation: by how much the velocity changed more than promised (length / time).");
  visit("distance", [](const Event& from) { return from.distance; },
        "Of a sensor: the sensor distance that was crossed (length).");
  visit("first_user_data", [](const Event& from) { return from.first_user_data; },
        "What the definition of the body gave.");
  visit("second_user_data", [](const Event& from) { return from.second_user_data; },
        "");
  visit("first_mass", [](const Event& from) { return from.first_mass; },
        "Of the body; infinite for a static body.");
  visit("second_mass", [](const Event& from) { return from.second_mass; },
        "Of the body; infinite for a static body and for a wall.");
  visit("first_part", [](const Event& from) { return from.first_part; },
        "Of a rigid body: the number of the part at the contact; of a mesh: that of the triangle; 0 for all others.");
  visit("second_part", [](const Event& from) { return from.second_part; },
        "");
  visit("first_angular_velocity", [](const Event& from) { return object_of_field(from.first_angular_velocity); },
        "Of a rigid body (radians / time); zero for all others.");
  visit("second_angular_velocity", [](const Event& from) { return object_of_field(from.second_angular_velocity); },
        "");
  visit("first_spin_gain", [](const Event& from) { return object_of_field(from.first_spin_gain); },
        "Change of the angular velocity of a rigid body by a unit impulse along the normal (radians / (mass length)).");
  visit("second_spin_gain", [](const Event& from) { return object_of_field(from.second_spin_gain); },
        "");
  visit("acceleration_limit", [](const Event& from) { return from.acceleration_limit; },
        "Of a bound violation: the acceleration limit that the body has from now on (length / time^2).");
}

/// Calls visit("name", function of an object, "documentation") for each property.
template <class Visit>
void each_monitor_event_property(const Visit& visit) {
  visit("kind", [](const MonitorEvent& from) { return object_of_field(from.kind); },
        "");
  visit("time", [](const MonitorEvent& from) { return from.time; },
        "");
  visit("first", [](const MonitorEvent& from) { return from.first; },
        "The track of the event; for a pair, the one with the lower id.");
  visit("level", [](const MonitorEvent& from) { return from.level; },
        "Of a verdict or a prediction: the separation level.");
  visit("since", [](const MonitorEvent& from) { return from.since; },
        "Time at which the verdict before began, -inf for a pair that was apart at all levels; of a prediction, time at which it began.");
  visit("likely_time", [](const MonitorEvent& from) { return from.likely_time; },
        "Of a prediction: the time at which the two come within; inf if they never do.");
  visit("closest_time", [](const MonitorEvent& from) { return from.closest_time; },
        "Of a prediction: the time of the closest approach.");
  visit("closest_distance", [](const MonitorEvent& from) { return from.closest_distance; },
        "Of a prediction: the distance then (length); for a cylinder that in the plane.");
  visit("position_excess", [](const MonitorEvent& from) { return from.position_excess; },
        "Of a contradiction: how far the position is outside of what was possible (length).");
  visit("velocity_excess", [](const MonitorEvent& from) { return from.velocity_excess; },
        "Of a contradiction: how far the velocity is outside (length / time).");
}

/// Calls visit("name", function of an object, "documentation") for each property.
template <class Visit>
void each_pair_answer_property(const Visit& visit) {
  visit("verdict", [](const PairAnswer& from) { return object_of_field(from.verdict); },
        "");
  visit("predicted", [](const PairAnswer& from) { return from.predicted; },
        "From `predicted` to `prediction_ended`.");
  visit("since", [](const PairAnswer& from) { return from.since; },
        "Time since which the verdict has held; -inf for a pair that is apart at all levels.");
  visit("until", [](const PairAnswer& from) { return from.until; },
        "A certain verdict is true until this time, whatever is reported.");
  visit("lower", [](const PairAnswer& from) { return from.lower; },
        "Lower limit of the distance now (length); for a cylinder, of that in the plane.");
  visit("upper", [](const PairAnswer& from) { return from.upper; },
        "Upper limit of it.");
  visit("closest_distance", [](const PairAnswer& from) { return from.closest_distance; },
        "Estimate, if both go straight on: distance at the closest approach; for a cylinder that in the plane.");
  visit("closest_time", [](const PairAnswer& from) { return from.closest_time; },
        "Estimate: the time of the closest approach.");
  visit("closest_horizontal", [](const PairAnswer& from) { return from.closest_horizontal; },
        "Estimate: the horizontal part of the distance at that time.");
  visit("closest_vertical", [](const PairAnswer& from) { return from.closest_vertical; },
        "Estimate: the vertical part.");
  visit("relative_speed", [](const PairAnswer& from) { return from.relative_speed; },
        "Estimate: speed of one relative to the other now.");
  visit("likely_time", [](const PairAnswer& from) { return from.likely_time; },
        "Estimate: time at which they first are within the separation; inf if they never are.");
  visit("inevitable_by", [](const PairAnswer& from) { return from.inevitable_by; },
        "The pair certainly is within at some time up to this one, whatever the tracks do within their limits.");
  visit("avoidable_until", [](const PairAnswer& from) { return from.avoidable_until; },
        "Estimate: if both go straight on until this time, no accelerations within their limits keep them out.");
  visit("ask", [](const PairAnswer& from) { return from.ask; },
        "The track whose report would tighten the bounds most.");
  visit("ask_by", [](const PairAnswer& from) { return from.ask_by; },
        "When that report is needed for the verdict to stay certain.");
}

}  // namespace kinesphere::python
