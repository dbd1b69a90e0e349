#include "kinesphere/to_string.hpp"

#include <concepts>
#include <cstdlib>
#include <type_traits>

#include "input/input_check.hpp"

namespace kinesphere {
namespace {

/// Returns the number in the fewest digits, of 15 or more, that give it back.
std::string value_text(double number) {
  std::string text = text_of(number, 15);
  for (int digits = 16; digits <= 17 && std::strtod(text.c_str(), nullptr) != number; ++digits)
    text = text_of(number, digits);
  return text;
}
std::string value_text(std::integral auto number) {
  if constexpr (std::same_as<decltype(number), bool>) return number ? "true" : "false";
  return std::to_string(number);
}
template <class Kind>
requires std::is_enum_v<Kind> std::string value_text(Kind kind) { return std::string(name_of(kind)); }
template <class Value>
requires requires(const Value& value) { to_string(value); }
std::string value_text(const Value& value) { return to_string(value); }
template <class Value>
std::string value_text(const std::optional<Value>& value) {
  return value ? value_text(*value) : "none";
}

/// Lists fields: names, each followed by its value.
std::string fields() { return {}; }
template <class Value>
std::string fields(std::string_view name, const Value& value, const auto&... others) {
  const std::string rest = fields(others...);
  return std::string(name) + " " + value_text(value) + (rest.empty() ? "" : ", " + rest);
}

}  // namespace

std::string_view name_of(Certainty certainty) {
  return certainty == Certainty::certainly ? "certainly" : "possibly";
}

std::string to_string(const Vec3& vector) {
  return "(" + value_text(vector.x) + ", " + value_text(vector.y) + ", " + value_text(vector.z) + ")";
}
std::string to_string(const Box& box) { return to_string(box.lower) + " to " + to_string(box.upper); }
std::string to_string(const State& state) {
  return to_string(state.position) + " moving " + to_string(state.velocity);
}
std::string to_string(const Filter& filter) {
  return fields("category", filter.category, "mask", filter.mask, "group", filter.group);
}
std::string to_string(const MotionLimits& limits) {
  return fields("acceleration_limit", limits.acceleration_limit, "planned_acceleration",
                limits.planned_acceleration, "position_error", limits.position_error, "velocity_error",
                limits.velocity_error);
}
std::string to_string(const BodyDefinition& body) {
  return fields("radius", body.radius, "position", body.position, "velocity", body.velocity) + ", " +
         to_string(motion_limits_of(body)) + ", " + to_string(body.filter) + ", " +
         fields("solid", body.solid, "sensor_class", body.sensor_class, "user_data", body.user_data, "mass",
                body.mass, "radius_rate", body.radius_rate);
}
std::string to_string(const Bound& bound) {
  return fields("time", bound.time, "position", bound.position, "velocity", bound.velocity,
                "planned_acceleration", bound.planned_acceleration, "radius", bound.radius, "growth_speed",
                bound.growth_speed, "acceleration_limit", bound.acceleration_limit);
}
std::string to_string(const Shape& shape) {
  struct Visitor {
    std::string operator()(const Ball& ball) const {
      return fields("ball: centre", ball.centre, "radius", ball.radius);
    }
    std::string operator()(const HalfSpace& half) const {
      return fields("half-space: normal", half.normal, "offset", half.offset);
    }
    std::string operator()(const Box& box) const { return fields("box:", box); }
    std::string operator()(const Triangle& triangle) const {
      return fields("triangle: a", triangle.a, "b", triangle.b, "c", triangle.c);
    }
    std::string operator()(const Mesh& mesh) const {
      return fields("mesh: triangles", mesh.size()) +
             (mesh.size() > 0 ? ", " + fields("in", bounding_box(mesh, 0.0)) : "");
    }
  };
  return std::visit(Visitor{}, shape);
}
std::string to_string(const BodyView& body) {
  return to_string(body.definition) + ", " +
         fields("box", body.box, "box_end", body.box_end, "enabled", body.enabled, "is_static",
                body.is_static, "sleeping", body.sleeping, "shape", body.shape);
}

std::string to_string(const Event& event) {
  std::string words = value_text(event.kind) + " of " + to_string(event.first);
  if (event.second != no_body) words += " and " + to_string(event.second);
  if (event.wall != Wall::none) words += " at " + value_text(event.wall);
  if (is_of_sensor(event.kind)) words += " at distance " + value_text(event.distance);
  return words + " at time " + value_text(event.time);
}
std::string to_string(const Response& response) {
  return fields("first_velocity", response.first_velocity, "second_velocity", response.second_velocity,
                "first_action", response.first_action, "second_action", response.second_action, "stop",
                response.stop);
}
std::string to_string(const ProbedState& report) {
  return "body " + to_string(report.body) + " at time " + value_text(report.time) + ": " +
         to_string(report.state);
}
std::string to_string(const MonitorEvent& event) {
  std::string words = value_text(event.kind) + " of " + value_text(event.first);
  if (is_of_pair(event.kind))
    words += " and " + value_text(event.second) + " at level " + value_text(event.level);
  if (event.kind == MonitorEventKind::verdict) words += ": " + value_text(event.verdict);
  return words + " at time " + value_text(event.time);
}
std::string to_string(const PairAnswer& answer) {
  return fields("verdict", answer.verdict, "since", answer.since, "until", answer.until, "lower",
                answer.lower, "upper", answer.upper, "closest_distance", answer.closest_distance,
                "closest_time", answer.closest_time, "inevitable_by", answer.inevitable_by, "predicted",
                answer.predicted);
}
std::string to_string(const Error& error) { return value_text(error.code) + ": " + error.message; }

std::string to_string(const SafeTime& safe) {
  return fields("time", safe.time, "touching", safe.touching, "probed", safe.probed);
}
std::string to_string(const EarliestContact& first) {
  return fields("time", first.time, "partner", first.partner, "wall", first.wall, "touching", first.touching,
                "probed", first.probed);
}
std::string to_string(const EarliestApproach& first) {
  return fields("time", first.time, "partner", first.partner, "wall", first.wall, "within", first.within,
                "probed", first.probed);
}
std::string to_string(const SafeSeparation& safe) {
  return fields("time", safe.time, "within", safe.within, "probed", safe.probed);
}
std::string to_string(const DistanceLimits& limits) {
  return fields("lower", limits.lower, "upper", limits.upper, "probed", limits.probed);
}

std::string to_string(const OverlapHit& hit) { return fields("body", hit.body, "certainty", hit.certainty); }
std::string to_string(const NearestHit& hit) {
  return fields("body", hit.body, "certainty", hit.certainty, "lower", hit.lower, "upper", hit.upper);
}
std::string to_string(const CastHit& hit) {
  return fields("body", hit.body, "certainty", hit.certainty, "lower", hit.lower, "upper", hit.upper);
}
std::string to_string(const SensorOverlap& overlap) {
  return fields("body", overlap.body, "distance", overlap.distance);
}

std::string to_string(const Counters& counters) {
  std::string words;
  for (int kind = 0; kind < event_kind_count; ++kind)
    words +=
        fields(name_of(static_cast<EventKind>(kind)), counters.count(static_cast<EventKind>(kind))) + ", ";
  return words + fields("probes", counters.probes, "window_ends", counters.window_ends, "starts",
                        counters.starts, "restarts", counters.restarts, "pair_checks", counters.pair_checks,
                        "wall_checks", counters.wall_checks, "searches", counters.searches, "candidates",
                        counters.candidates, "hot_pairs", counters.hot_pairs, "certificates",
                        counters.certificates, "zeno_steps", counters.zeno_steps, "repeated_contacts",
                        counters.repeated_contacts);
}
std::string to_string(const Memory& memory) {
  return fields("bodies", memory.bodies, "windows", memory.windows, "pairs", memory.pairs, "contacts",
                memory.contacts, "recording", memory.recording, "other", memory.other);
}
std::string to_string(const Certificate& certificate) {
  return fields("first", certificate.first, "second", certificate.second, "until", certificate.until);
}
std::string to_string(const BusyBody& body) {
  return fields("body", body.body, "reason", body.reason, "probes", body.probes, "contacts", body.contacts);
}
std::string to_string(const AuditFinding& finding) { return finding.where + ": " + finding.what; }

}  // namespace kinesphere
