#include "world/validation.hpp"

#include <cmath>
#include <cstdio>
#include <string>

namespace kinesphere {
namespace {

/// Beyond this, squares would overflow.
constexpr double magnitude_limit = 1e100;
/// Coordinates reach this many contact tolerances: then the rounding of a certificate stays well within one.
constexpr double coordinate_limit_in_tolerances = 0x1p44;

std::string text_of(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

std::string text_of(const Vec3& v) {
  return "(" + text_of(v.x) + ", " + text_of(v.y) + ", " + text_of(v.z) + ")";
}

/// Collects the first thing that is wrong.
class Check {
 public:
  Check(std::string_view call, BodyId body = no_body) : call_(call), body_(body) {}

  Check& number(std::string_view argument, double value, double least, bool open = false) {
    const bool in_range = open ? value > least : value >= least;
    if (!std::isfinite(value) || !in_range || value > magnitude_limit) {
      fail(std::isfinite(value) ? ErrorCode::out_of_range : ErrorCode::not_finite, argument,
           std::string("must be a finite number ") + (open ? "> " : ">= ") + text_of(least), text_of(value));
    }
    return *this;
  }

  Check& vector(std::string_view argument, const Vec3& value, double limit = magnitude_limit) {
    if (!is_finite(value)) {
      fail(ErrorCode::not_finite, argument, "must be finite", text_of(value));
    } else if (!(std::max({std::abs(value.x), std::abs(value.y), std::abs(value.z)}) <= limit)) {
      fail(ErrorCode::out_of_range, argument, "must be within +-" + text_of(limit) + " on each axis",
           text_of(value));
    }
    return *this;
  }

  void fail(ErrorCode code, std::string_view argument, const std::string& expected,
            const std::string& found) {
    if (error_) return;
    std::string message = std::string(call_) + ": " + std::string(argument);
    if (body_ != no_body) message += " of " + kinesphere::text_of(body_);
    error_ = Error{code, std::string(argument), body_, message + " " + expected + ", but is " + found};
  }

  bool failed() const { return error_.has_value(); }
  Result<void> result() const { return error_ ? Result<void>(*error_) : Result<void>(); }

 private:
  std::string_view call_;
  BodyId body_;
  std::optional<Error> error_;
};

double coordinate_limit(const WorldDefinition& world) {
  return coordinate_limit_in_tolerances * world.contact_tolerance;
}

}  // namespace

std::string text_of(BodyId body) {
  std::string text = "body " + std::to_string(body.index);
  if (body.generation != 0) text += " (generation " + std::to_string(body.generation) + ")";
  return text;
}

Result<void> check_world(const WorldDefinition& definition) {
  Check check("World::create");
  check.number("contact_tolerance", definition.contact_tolerance, 0.0, true);
  if (!std::isnan(definition.separation_distance))
    check.number("separation_distance", definition.separation_distance, definition.contact_tolerance, true);
  check.number("zeno_interval", definition.zeno_interval, 0.0);
  check.number("start_time", definition.start_time, -magnitude_limit);
  if (definition.box) {
    const Box& box = *definition.box;
    check.vector("box.lower", box.lower, coordinate_limit(definition));
    check.vector("box.upper", box.upper, coordinate_limit(definition));
    for (int axis = 0; axis < 3; ++axis)
      if (!(box.lower[axis] < box.upper[axis]))
        check.fail(ErrorCode::out_of_range, "box", "must have lower < upper on each axis",
                   text_of(box.lower) + " to " + text_of(box.upper));
  }
  return check.result();
}

Result<void> check_body(const BodyDefinition& body, const WorldDefinition& world, std::string_view call) {
  Check check(call);
  check.number("radius", body.radius, 0.0)
      .number("acceleration_limit", body.acceleration_limit, 0.0)
      .number("position_error", body.position_error, 0.0)
      .number("velocity_error", body.velocity_error, 0.0)
      .vector("planned_acceleration", body.planned_acceleration)
      .vector("position", body.position, coordinate_limit(world))
      .vector("velocity", body.velocity);
  if (check.failed() || !world.box) return check.result();
  for (int axis = 0; axis < 3; ++axis) {
    const double depth =
        world.allow_overlap ? 0.0 : body.radius + body.position_error - world.contact_tolerance;
    if (body.position[axis] - depth < world.box->lower[axis] ||
        body.position[axis] + depth > world.box->upper[axis]) {
      check.fail(ErrorCode::outside_domain, "position",
                 "must lie in the box from " + text_of(world.box->lower) + " to " +
                     text_of(world.box->upper) +
                     (world.allow_overlap ? "" : ", with its whole sphere of radius " + text_of(body.radius)),
                 text_of(body.position));
    }
  }
  return check.result();
}

Result<void> check_velocity(const Vec3& velocity, BodyId body, std::string_view call) {
  return Check(call, body).vector("velocity", velocity).result();
}

Result<void> check_report(const State& state, BodyId body, double time, const WorldDefinition& world) {
  const std::string call = "advance: the probe's answer at time " + text_of(time);
  return Check(call, body)
      .vector("position", state.position, coordinate_limit(world))
      .vector("velocity", state.velocity)
      .result();
}

Result<void> check_time(double until, double now) {
  Check check("advance");
  if (!std::isfinite(until)) {
    check.fail(ErrorCode::not_finite, "until", "must be a finite time", text_of(until));
  } else if (until < now) {
    check.fail(ErrorCode::time_backwards, "until", "must not lie before the current time " + text_of(now),
               text_of(until));
  }
  return check.result();
}

}  // namespace kinesphere
