#include "world/validation.hpp"

#include <cmath>
#include <string>

#include "input/input_check.hpp"

namespace kinesphere {
namespace {

/// Beyond this, squares would overflow.
constexpr double magnitude_limit = 1e100;

/// With this, coordinates still fit into the single precision of the grid.
constexpr double tolerance_limit = 1e20;

/// Lengths reach this many contact tolerances: then the rounding of a certificate stays well within one.
double coordinate_limit(const WorldDefinition& world) { return 0x1p41 * world.contact_tolerance; }

}  // namespace

Result<void> check_world(const WorldDefinition& definition) {
  InputCheck check("World::create");
  check.positive({"contact_tolerance"}, definition.contact_tolerance)
      .require(definition.contact_tolerance <= tolerance_limit, ErrorCode::out_of_range,
               {"contact_tolerance"}, "must be at most", tolerance_limit, definition.contact_tolerance)
      .not_negative({"zeno_interval"}, definition.zeno_interval)
      .finite({"start_time"}, definition.start_time);
  if (!std::isnan(definition.separation_distance)) {
    check.finite({"separation_distance"}, definition.separation_distance)
        .require(definition.separation_distance > definition.contact_tolerance, ErrorCode::out_of_range,
                 {"separation_distance"}, "must be larger than contact_tolerance",
                 definition.contact_tolerance, definition.separation_distance);
  }
  if (definition.box) {
    check.box({"box"}, *definition.box)
        .within({"box", no_body, "lower"}, definition.box->lower, coordinate_limit(definition))
        .within({"box", no_body, "upper"}, definition.box->upper, coordinate_limit(definition));
  }
  return check.result();
}

Result<void> check_body(const BodyDefinition& body, const WorldDefinition& world, std::string_view call) {
  InputCheck check(call);
  const auto size = [&check](std::string_view argument, double value, double limit) {
    check.not_negative({argument}, value)
        .require(value <= limit, ErrorCode::out_of_range, {argument}, "must be at most", limit, value);
  };
  size("radius", body.radius, coordinate_limit(world));
  size("acceleration_limit", body.acceleration_limit, magnitude_limit);
  size("position_error", body.position_error, coordinate_limit(world));
  size("velocity_error", body.velocity_error, magnitude_limit);
  check.within({"planned_acceleration"}, body.planned_acceleration, magnitude_limit)
      .within({"position"}, body.position, coordinate_limit(world))
      .within({"velocity"}, body.velocity, magnitude_limit);
  if (!world.box) return check.result();
  const double reach =
      world.allow_overlap ? 0.0 : body.radius + body.position_error - world.contact_tolerance;
  for (int axis = 0; axis < 3; ++axis) {
    check.require(body.position[axis] - reach >= world.box->lower[axis] &&
                      body.position[axis] + reach <= world.box->upper[axis],
                  ErrorCode::outside_domain, {"position"},
                  world.allow_overlap ? "must lie in the box" : "must keep the whole sphere in the box",
                  *world.box, body.position);
  }
  return check.result();
}

Result<void> check_velocity(const Vec3& velocity, BodyId body, std::string_view call) {
  return InputCheck(call).within({"velocity", body}, velocity, magnitude_limit).result();
}

Result<void> check_report(const State& state, BodyId body, double time, const WorldDefinition& world) {
  // Nearly all reports are fine: words cost time.
  const auto fits = [](const Vec3& v, double limit) {
    return std::abs(v.x) <= limit && std::abs(v.y) <= limit && std::abs(v.z) <= limit;
  };
  if (fits(state.position, coordinate_limit(world)) && fits(state.velocity, magnitude_limit)) return {};
  const std::string call = "advance: the probe's answer at time " + text_of(time);
  return InputCheck(call)
      .within({"position", body}, state.position, coordinate_limit(world))
      .within({"velocity", body}, state.velocity, magnitude_limit)
      .result();
}

Result<void> check_time(double until, double now) {
  return InputCheck("advance")
      .finite({"until"}, until)
      .require(until >= now, ErrorCode::time_backwards, {"until"}, "must not lie before the current time",
               now, until)
      .result();
}

}  // namespace kinesphere
