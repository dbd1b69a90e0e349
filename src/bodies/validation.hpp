// Validation of all input to a world. Each function returns an error that names the argument and the body.
#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <string_view>

#include "input/input_check.hpp"
#include "kinesphere/limits.hpp"
#include "kinesphere/world.hpp"

namespace kinesphere {

struct RigidRecord;

Result<void> check_world(const WorldDefinition& definition);
/// Validates that images do not slide (WorldDefinition::shear_rate), for what cannot be where they do.
Result<void> check_no_shear(const WorldDefinition& definition, std::string_view call);
/// `call` is the name of the API function, for the message.
Result<void> check_body(const BodyDefinition& body, const WorldDefinition& world, std::string_view call);
Result<void> check_shape(const Shape& shape, const WorldDefinition& world, std::string_view call);
/// Validates a shape that a body carries: a box, a triangle or a mesh, where no axis is periodic.
Result<void> check_carried_shape(const Shape& shape, const WorldDefinition& world, std::string_view call);
/// Validates a moving shape that is to be added, except for the room that it takes. Returns it as a world
/// keeps it.
Result<MovingShape> accepted_moving_shape(const MovingShape& added, const WorldDefinition& world,
                                          std::string_view call);
/// Validates what a rigid body adds to its BodyDefinition.
Result<void> check_rigid_body(const RigidBody& body, const WorldDefinition& world, std::string_view call);
/// Validates a rigid body that is to be added, except for its sensor reach and the room that it takes.
Result<void> check_new_rigid_body(const RigidBody& body, const WorldDefinition& world, std::string_view call);
/// Validates that a body that is not a ball keeps its size.
Result<void> check_keeps_size(const BodyDefinition& body, std::string_view call);
Result<void> check_rotation(const Rotation& rotation, BodyId body, const WorldDefinition& world,
                            std::string_view call);
/// Validates an angular velocity that a body is to get. `turning` is nullptr if the body is not rigid.
Result<void> check_spin(const Vec3& angular_velocity, const RigidRecord* turning, BodyId body,
                        const WorldDefinition& world, std::string_view call);
/// Validates a changed radius or changed motion limits of a body that is in the world already.
Result<void> check_radius(const BodyDefinition& changed, BodyId body, const WorldDefinition& world,
                          std::string_view call);
/// Validates a rate at which the radius of a body is to change.
Result<void> check_radius_rate(double rate, BodyId body, std::string_view call);
/// Validates that a body whose radius has changed with time is not too large, with its sensor reach (length).
Result<void> check_grown(const BodyDefinition& grown, double reach, BodyId body, const WorldDefinition& world,
                         std::string_view call);
Result<void> check_limits(const BodyDefinition& changed, BodyId body, const WorldDefinition& world,
                          std::string_view call);
Result<void> check_state(const State& state, const BodyDefinition& definition, BodyId body,
                         const WorldDefinition& world, std::string_view call);
Result<void> check_sensor(const Sensor& sensor, const WorldDefinition& world);
/// Returns the room that a body with this sensor reach (length) takes on a periodic axis (length). It must be
/// at most margin_in_period().
double needed_in_period(const BodyDefinition& body, double reach, const WorldDefinition& world);
/// Precondition: the axis is periodic.
double margin_in_period(const WorldDefinition& world, int axis);
/// Validates that a body with this sensor reach (length) is small enough for periodic space.
Result<void> check_reach(double reach, const BodyDefinition& body, BodyId id, std::string_view argument,
                         const WorldDefinition& world, std::string_view call);
Result<void> check_velocity(const Vec3& velocity, BodyId body, const WorldDefinition& world,
                            std::string_view call);
Result<void> check_report(const State& state, BodyId body, double time, const WorldDefinition& world,
                          std::string_view call = "advance");
/// Initial value of states that a probe or a motion source fills in. check_report() refuses it, which detects
/// missing answers.
inline constexpr double not_said = std::numeric_limits<double>::quiet_NaN();
inline constexpr State no_answer{{not_said, not_said, not_said}, {not_said, not_said, not_said}};
inline constexpr Rotation no_rotation{{not_said, not_said, not_said, not_said}, {}};
Result<void> check_time(double until, double now, const WorldDefinition& world);
Result<void> check_timer(const Timer& timer, double now);
/// Returns the error of a call on a world that has been moved from.
Error moved_from_error(std::string_view call);

/// Returns the largest coordinate (length): a fixed number of contact tolerances, so that rounding errors of
/// certificates stay well below one tolerance.
inline double coordinate_limit(const WorldDefinition& world) {
  return limits::largest_length * world.contact_tolerance;
}
inline bool fits(const Vec3& v, double limit) {
  return std::abs(v.x) <= limit && std::abs(v.y) <= limit && std::abs(v.z) <= limit;
}
/// Returns true if check_velocity() accepts the velocity.
inline bool is_valid_velocity(const Vec3& velocity, const WorldDefinition& world) {
  return fits(velocity, limits::largest_speed) && (world.dimensions == 3 || velocity.z == 0.0);
}
/// Returns true if the position, in whichever image, is near enough to be wrapped into periodic space.
bool fits_in_images(const Vec3& position, const WorldDefinition& world);
/// Returns true if check_report() accepts the state.
inline bool is_valid_report(const State& state, const WorldDefinition& world) {
  return (fits(state.position, coordinate_limit(world)) || fits_in_images(state.position, world)) &&
         is_valid_velocity(state.velocity, world) && (world.dimensions == 3 || state.position.z == 0.0);
}

/// Returns the error of a body that would overlap `other`.
Error overlap_error(std::string_view call, BodyId other, const std::string& name_of_other,
                    std::string_view argument = "position");
/// Returns the error of a rigid body that would overlap a wall.
Error wall_error(std::string_view call, BodyId body, Wall wall);
/// Requires a length of a query to be between 0 and four times the largest coordinate.
InputCheck& require_length(InputCheck& check, std::string_view argument, double length,
                           const WorldDefinition& world);
/// Requires z = 0 in two dimensions.
void require_plane(InputCheck& check, const Subject& subject, const Vec3& value,
                   const WorldDefinition& world);

/// Returns the first result that is an error, or success.
template <class... Checks>
Result<void> first_error(const Checks&... checks) {
  Result<void> result;
  (void)((static_cast<bool>(checks) || (result = checks, false)) && ...);
  return result;
}

}  // namespace kinesphere
