#include "bodies/validation.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <utility>

#include "bodies/shaped_body.hpp"
#include "bound/mesh_tree.hpp"
#include "bound/triangle.hpp"
#include "contact/contact_rule.hpp"
#include "kinesphere/limits.hpp"
#include "space/space.hpp"

namespace kinesphere {
namespace {

void require_radius(InputCheck& check, double radius, BodyId body, const WorldDefinition& world) {
  check.from_zero_to({"radius", body}, radius, coordinate_limit(world));
}

void require_radius_rate(InputCheck& check, double rate, BodyId body) {
  check.within({"radius_rate", body}, rate, limits::largest_speed);
}

/// Ensures that a pair can meet in one image only; space/space.hpp has the limit and the proof. `reach`: the
/// sensor distance of the body.
void require_fit(InputCheck& check, std::string_view argument, const BodyDefinition& definition, double reach,
                 BodyId body, const WorldDefinition& world) {
  if (!world.box) return;
  for (int axis = 0; axis < 3; ++axis) {
    if (!world.periodic[axis]) continue;
    const double needed = needed_in_period(definition, reach, world);
    const double margin = margin_in_period(world, axis);
    check.require(needed <= margin, ErrorCode::out_of_range, {argument, body},
                  reach == 0.0
                      ? "must leave 2 radius + 6 position_error + separation_distance + contact_tolerance at "
                        "most 3/8 of "
                        "the periodic box, which is"
                      : "must leave 2 (radius + sensor distance) + 6 position_error + separation_distance + "
                        "contact_tolerance at most 3/8 of the periodic box, which is",
                  margin, needed);
  }
}

void require_limits(InputCheck& check, const MotionLimits& motion, BodyId body,
                    const WorldDefinition& world) {
  check.from_zero_to({"acceleration_limit", body}, motion.acceleration_limit, limits::largest_acceleration)
      .from_zero_to({"position_error", body}, motion.position_error, coordinate_limit(world))
      .from_zero_to({"velocity_error", body}, motion.velocity_error, limits::largest_speed)
      .within({"planned_acceleration", body}, motion.planned_acceleration, limits::largest_acceleration);
  require_plane(check, {"planned_acceleration", body}, motion.planned_acceleration, world);
}

void require_state(InputCheck& check, const State& state, const BodyDefinition& definition, BodyId body,
                   const WorldDefinition& world) {
  check.within({"position", body}, state.position, coordinate_limit(world))
      .within({"velocity", body}, state.velocity, limits::largest_speed);
  require_plane(check, {"position", body}, state.position, world);
  require_plane(check, {"velocity", body}, state.velocity, world);
  if (!world.box || !meets_walls(world, definition.filter)) return;
  const double reach =
      world.allow_overlap ? 0.0 : definition.radius + definition.position_error - world.contact_tolerance;
  for (int axis = 0; axis < world.dimensions; ++axis) {
    if (world.periodic[axis]) continue;
    check.require(state.position[axis] - reach >= world.box->lower[axis] &&
                      state.position[axis] + reach <= world.box->upper[axis],
                  ErrorCode::outside_domain, {"position", body},
                  world.allow_overlap ? "must lie in the box" : "must keep the whole sphere in the box",
                  *world.box, state.position);
  }
}

/// Requires a contact tolerance that doubles can resolve at the corners of the box: coordinate_limit().
void require_tolerance_for(InputCheck& check, const Box& box, const WorldDefinition& world) {
  double farthest = 0.0;
  for (int axis = 0; axis < 3; ++axis)
    farthest = std::max({farthest, std::abs(box.lower[axis]), std::abs(box.upper[axis])});
  if (check.error() || farthest <= coordinate_limit(world)) return;
  const double needed = farthest / limits::largest_length;
  const std::string wanted = "must be at least " + text_of(needed) + " for a box that reaches to " +
                             text_of(farthest) + " (2^41 tolerances reach no farther)";
  check
      .require(needed > limits::largest_contact_tolerance, ErrorCode::out_of_range, {"contact_tolerance"},
               wanted, world.contact_tolerance)
      .within({"box", no_body, "lower"}, box.lower, coordinate_limit(world))
      .within({"box", no_body, "upper"}, box.upper, coordinate_limit(world));
}

/// Returns the names of the axes, such as "x and z".
std::string_view names_of(const Axes& axes) {
  constexpr std::string_view names[] = {"no axis", "x",       "y",       "x and y",
                                        "z",       "x and z", "y and z", "x, y and z"};
  return names[(axes.x ? 1 : 0) + (axes.y ? 2 : 0) + (axes.z ? 4 : 0)];
}

void require_shape(InputCheck& check, const Ball& ball, const WorldDefinition& world) {
  check.within({"shape", no_body, "centre"}, ball.centre, coordinate_limit(world));
  require_plane(check, {"shape", no_body, "centre"}, ball.centre, world);
  require_radius(check, ball.radius, no_body, world);
}

void require_shape(InputCheck& check, const HalfSpace& solid, const WorldDefinition& world) {
  check.within({"shape", no_body, "normal"}, solid.normal, 2.0)
      .require(std::abs(norm(solid.normal) - 1.0) <= 1e-6, ErrorCode::out_of_range,
               {"shape", no_body, "normal"}, "must have length 1", solid.normal)
      .within({"shape", no_body, "offset"}, solid.offset, coordinate_limit(world));
  require_plane(check, {"shape", no_body, "normal"}, solid.normal, world);
}

void require_shape(InputCheck& check, const Box& box, const WorldDefinition& world) {
  check.within({"shape", no_body, "lower"}, box.lower, coordinate_limit(world))
      .within({"shape", no_body, "upper"}, box.upper, coordinate_limit(world));
  for (int axis = 0; axis < 3; ++axis)
    check.require(box.lower[axis] <= box.upper[axis], ErrorCode::out_of_range, {"shape"},
                  "must have lower <= upper on each axis", box);
}

void require_shape(InputCheck& check, const Triangle& triangle, const WorldDefinition& world) {
  check.require(world.dimensions == 3, ErrorCode::unsupported, {"shape"}, "must not be a triangle",
                std::string_view("one in a plane"));
  for (const Vec3& corner : {triangle.a, triangle.b, triangle.c})
    check.within({"shape", no_body, "corner"}, corner, coordinate_limit(world));
  if (check.error()) return;
  const double thick = thickness(triangle);
  check.require(thick >= least_thickness, ErrorCode::out_of_range, {"shape"},
                "must be a triangle whose least height, relative to its longest side, is at least",
                least_thickness, thick);
}

void require_shape(InputCheck& check, const Mesh& mesh, const WorldDefinition& world) {
  check
      .require(world.dimensions == 3 || mesh.is_chain(), ErrorCode::unsupported, {"shape"},
               "must be a mesh that Mesh::chain() makes", std::string_view("another one in a plane"))
      .require(mesh.size() > 0, ErrorCode::out_of_range, {"shape"}, "must be a mesh with triangles",
               std::string_view("one without"));
  if (check.error()) return;
  const Box& box = tree_of(mesh).box();
  check.within({"shape", no_body, "vertices"}, box.lower, coordinate_limit(world))
      .within({"shape", no_body, "vertices"}, box.upper, coordinate_limit(world));
}

void require_contact_events(InputCheck& check, ContactEvents contacts) {
  check.require(contacts >= ContactEvents::impacts && contacts <= ContactEvents::all, ErrorCode::out_of_range,
                {"contacts"}, "must be impacts, begin_and_end or all", static_cast<double>(contacts));
}

}  // namespace

InputCheck& require_length(InputCheck& check, std::string_view argument, double length,
                           const WorldDefinition& world) {
  return check.from_zero_to({argument}, length, limits::largest_query_length * world.contact_tolerance);
}

void require_plane(InputCheck& check, const Subject& subject, const Vec3& value,
                   const WorldDefinition& world) {
  check.require(world.dimensions == 3 || value.z == 0.0, ErrorCode::out_of_range, subject,
                "must have z = 0 in two dimensions", value);
}

namespace {

/// Returns the time from which on images that slide go too far between two times that there are.
double time_of_coarse_slides(const WorldDefinition& world) {
  if (world.shear_rate == 0.0) return limits::largest_time;
  const Space space(world);
  return 0x1p48 * Space::most_slide * space.period().x / std::abs(space.slide_speed());
}

}  // namespace

Result<void> check_world(const WorldDefinition& definition) {
  InputCheck check("World::create");
  check.positive({"contact_tolerance"}, definition.contact_tolerance)
      .require(definition.contact_tolerance >= limits::least_contact_tolerance, ErrorCode::out_of_range,
               {"contact_tolerance"}, "must be at least", limits::least_contact_tolerance,
               definition.contact_tolerance)
      .require(definition.contact_tolerance <= limits::largest_contact_tolerance, ErrorCode::out_of_range,
               {"contact_tolerance"}, "must be at most", limits::largest_contact_tolerance,
               definition.contact_tolerance)
      .not_negative({"zeno_interval"}, definition.zeno_interval)
      .within({"start_time"}, definition.start_time, limits::largest_time);
  require_contact_events(check, definition.contacts);
  if (!std::isnan(definition.separation_distance)) {
    check.finite({"separation_distance"}, definition.separation_distance)
        .require(definition.separation_distance > definition.contact_tolerance, ErrorCode::out_of_range,
                 {"separation_distance"}, "must be larger than contact_tolerance",
                 definition.contact_tolerance, definition.separation_distance)
        .require(definition.separation_distance <= coordinate_limit(definition), ErrorCode::out_of_range,
                 {"separation_distance"}, "must be at most", coordinate_limit(definition),
                 definition.separation_distance);
  }
  const int dimensions = definition.dimensions;
  check.require(dimensions == 2 || dimensions == 3, ErrorCode::out_of_range, {"dimensions"}, "must be 2 or 3",
                static_cast<double>(dimensions));
  if (definition.box) {
    Box box = *definition.box;
    if (dimensions == 2) std::tie(box.lower.z, box.upper.z) = std::pair(0.0, coordinate_limit(definition));
    check.box({"box"}, box);
    require_tolerance_for(check, box, definition);
  }
  const std::string_view axes = names_of(definition.periodic);
  check
      .require(definition.box || !definition.periodic.any(), ErrorCode::out_of_range, {"periodic"},
               "must be no axis where there is no box to give the period", axes)
      .require(dimensions == 3 || !definition.periodic.z, ErrorCode::out_of_range, {"periodic"},
               "must be x, y or both in two dimensions, where there is no z", axes);
  check.finite({"shear_rate"}, definition.shear_rate);
  if (definition.shear_rate != 0.0) {
    check.require(definition.periodic.x && definition.periodic.y, ErrorCode::out_of_range, {"shear_rate"},
                  "must be 0 unless x and y are periodic", definition.shear_rate);
    if (!check.error()) {
      const double speed = definition.shear_rate * (definition.box->upper.y - definition.box->lower.y);
      check.require(
          std::abs(speed) <= limits::largest_speed && std::abs(speed) >= 1.0 / limits::largest_speed,
          ErrorCode::out_of_range, {"shear_rate"},
          "must give speeds from 1e-100 to 1e100 across the box, but gives", speed, definition.shear_rate);
    }
    if (!check.error()) {
      const double latest = time_of_coarse_slides(definition);
      check.require(std::abs(definition.start_time) <= latest, ErrorCode::out_of_range, {"start_time"},
                    "must, so that times tell images apart that slide, be within +-", latest,
                    definition.start_time);
    }
  }
  // The box must be large enough for a body of radius 0.
  if (!check.error()) require_fit(check, "box", {.radius = 0.0}, 0.0, no_body, definition);
  return check.result();
}

Result<void> check_no_shear(const WorldDefinition& definition, std::string_view call) {
  return InputCheck(call)
      .require(definition.shear_rate == 0.0, ErrorCode::unsupported, {"shear_rate"},
               "must be 0 for this call", definition.shear_rate)
      .result();
}

double needed_in_period(const BodyDefinition& body, double reach, const WorldDefinition& world) {
  return 2.0 * (body.radius + reach) + 6.0 * body.position_error + ContactRule(world).release_gap();
}

double margin_in_period(const WorldDefinition& world, int axis) {
  return 0.375 * (world.box->upper[axis] - world.box->lower[axis]);
}

Result<void> check_body(const BodyDefinition& body, const WorldDefinition& world, std::string_view call) {
  InputCheck check(call);
  require_radius(check, body.radius, no_body, world);
  require_limits(check, motion_limits_of(body), no_body, world);
  require_state(check, {body.position, body.velocity}, body, no_body, world);
  require_fit(check, "radius", body, 0.0, no_body, world);
  if (body.contacts) require_contact_events(check, *body.contacts);
  check.not_negative_or_infinite({"mass"}, body.mass);
  require_radius_rate(check, body.radius_rate, no_body);
  return check.result();
}

Result<void> check_shape(const Shape& shape, const WorldDefinition& world, std::string_view call) {
  if (auto valid = check_no_shear(world, call); !valid) return valid;
  InputCheck check(call);
  std::visit([&](const auto& solid) { require_shape(check, solid, world); }, shape);
  const bool repeats = world.periodic.x || world.periodic.y || world.periodic.z;
  if (auto valid = check.result(); !valid || !repeats || std::holds_alternative<Ball>(shape)) return valid;
  return Error{ErrorCode::unsupported, "shape", no_body,
               std::string(call) + ": shape must be a ball where space repeats"};
}

Result<void> check_carried_shape(const Shape& shape, const WorldDefinition& world, std::string_view call) {
  const auto unsupported = [&](std::string_view wanted) {
    return Error{ErrorCode::unsupported, "shape", no_body,
                 std::string(call) + ": shape must " + std::string(wanted)};
  };
  if (world.periodic.any())
    return unsupported("not move where space repeats; add_rigid_body() takes boxes there");
  if (auto valid = check_shape(shape, world, call); !valid) return valid;
  if (!std::holds_alternative<Ball>(shape) && !std::holds_alternative<HalfSpace>(shape)) return {};
  return unsupported("be a box, a triangle or a mesh; a body is a ball without one");
}

/// It may be anywhere, since walls do not meet it.
Result<MovingShape> accepted_moving_shape(const MovingShape& added, const WorldDefinition& world,
                                          std::string_view call) {
  if (auto valid = check_keeps_size(added.body, call); !valid) return valid.error();
  if (auto valid = check_carried_shape(added.shape, world, call); !valid) return valid.error();
  const MovingShape accepted{added.body, normalized_carried(added.shape, world)};
  WorldDefinition without_walls = world;
  without_walls.box.reset();
  if (auto valid = check_body(body_of(accepted, world), without_walls, call); !valid) return valid.error();
  return accepted;
}

Result<void> check_radius(const BodyDefinition& changed, BodyId body, const WorldDefinition& world,
                          std::string_view call) {
  InputCheck check(call);
  require_radius(check, changed.radius, body, world);
  require_fit(check, "radius", changed, 0.0, body, world);
  return check.result();
}

Result<void> check_radius_rate(double rate, BodyId body, std::string_view call) {
  InputCheck check(call);
  require_radius_rate(check, rate, body);
  return check.result();
}

Result<void> check_grown(const BodyDefinition& grown, double reach, BodyId body, const WorldDefinition& world,
                         std::string_view call) {
  auto valid = check_radius(grown, body, world, call);
  return valid ? check_reach(reach, grown, body, "radius", world, call) : valid;
}

Result<void> check_limits(const BodyDefinition& changed, BodyId body, const WorldDefinition& world,
                          std::string_view call) {
  InputCheck check(call);
  require_limits(check, motion_limits_of(changed), body, world);
  require_fit(check, "position_error", changed, 0.0, body, world);
  return check.result();
}

Result<void> check_state(const State& state, const BodyDefinition& definition, BodyId body,
                         const WorldDefinition& world, std::string_view call) {
  InputCheck check(call);
  require_state(check, state, definition, body, world);
  return check.result();
}

Result<void> check_sensor(const Sensor& sensor, const WorldDefinition& world) {
  InputCheck check("set_sensor");
  for (std::size_t number = 0; number < sensor.distances.size(); ++number)
    check.from_zero_to({"sensor", no_body, "distance", number}, sensor.distances[number],
                       coordinate_limit(world));
  return check.result();
}

Result<void> check_reach(double reach, const BodyDefinition& body, BodyId id, std::string_view argument,
                         const WorldDefinition& world, std::string_view call) {
  if (!world.periodic.any()) return {};
  InputCheck check(call);
  require_fit(check, argument, body, reach, id, world);
  return check.result();
}

Result<void> check_velocity(const Vec3& velocity, BodyId body, const WorldDefinition& world,
                            std::string_view call) {
  if (is_valid_velocity(velocity, world)) return {};
  InputCheck check(call);
  check.within({"velocity", body}, velocity, limits::largest_speed);
  require_plane(check, {"velocity", body}, velocity, world);
  return check.result();
}

namespace {

/// Returns the largest coordinate of a report on an axis (length).
double report_limit(const WorldDefinition& world, int axis) {
  const double limit = world.periodic[axis] ? limits::largest_image : limits::largest_length;
  return limit * world.contact_tolerance;
}

}  // namespace

bool fits_in_images(const Vec3& position, const WorldDefinition& world) {
  for (int axis = 0; axis < 3; ++axis)
    if (!(std::abs(position[axis]) <= report_limit(world, axis))) return false;
  return true;
}

Result<void> check_report(const State& state, BodyId body, double time, const WorldDefinition& world,
                          std::string_view call) {
  if (is_valid_report(state, world)) return {};
  const std::string answer = std::string(call) + ": the probe's answer at time " + text_of(time);
  InputCheck check(answer);
  if (world.periodic.any()) {
    check.finite({"position", body}, state.position);
    for (int axis = 0; axis < 3; ++axis) {
      const double limit = report_limit(world, axis);
      check.require(std::abs(state.position[axis]) <= limit, ErrorCode::out_of_range, {"position", body},
                    world.periodic[axis] ? "must be wrapped into the periodic box, at the latest within +-"
                                         : "must lie within +-",
                    limit, state.position);
    }
  } else {
    check.within({"position", body}, state.position, coordinate_limit(world));
  }
  check.within({"velocity", body}, state.velocity, limits::largest_speed);
  require_plane(check, {"position", body}, state.position, world);
  require_plane(check, {"velocity", body}, state.velocity, world);
  return check.result();
}

Result<void> check_time(double until, double now, const WorldDefinition& world) {
  if (until >= now && until <= limits::largest_time &&
      (world.shear_rate == 0.0 || until <= time_of_coarse_slides(world)))
    return {};
  return InputCheck("advance")
      .finite({"until"}, until)
      .require(until <= limits::largest_time, ErrorCode::out_of_range, {"until"}, "must be at most",
               limits::largest_time, until)
      .require(until <= time_of_coarse_slides(world), ErrorCode::out_of_range, {"until"},
               "must, so that times tell images apart that slide, be at most", time_of_coarse_slides(world),
               until)
      .require(until >= now, ErrorCode::time_backwards, {"until"}, "must not lie before the current time",
               now, until)
      .result();
}

Result<void> check_timer(const Timer& timer, double now) {
  return InputCheck("schedule")
      .within({"time"}, timer.time, limits::largest_time)
      .require(timer.time >= now, ErrorCode::time_backwards, {"time"}, "must not lie before the current time",
               now, timer.time)
      .from_zero_to({"period"}, timer.period, limits::largest_time)
      .result();
}

Error overlap_error(std::string_view call, BodyId other, const std::string& name_of_other,
                    std::string_view argument) {
  return {ErrorCode::overlapping, std::string(argument), other,
          std::string(call) + ": " + std::string(argument) +
              " must not overlap another body, but the body would overlap " + name_of_other};
}

Error wall_error(std::string_view call, BodyId body, Wall wall) {
  return {ErrorCode::outside_domain, "parts", body,
          std::string(call) + ": parts must lie in the box, but would overlap the wall " +
              std::string(name_of(wall))};
}

Error moved_from_error(std::string_view call) {
  return {ErrorCode::moved_from, "world", no_body,
          std::string(call) + ": world must be one that has not been moved from"};
}

}  // namespace kinesphere
