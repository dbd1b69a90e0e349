#include "contact/contact_event.hpp"

#include <cmath>
#include <tuple>
#include <utility>

#include "bound/mesh_tree.hpp"
#include "bound/nearest_parts.hpp"
#include "bound/rigid_part.hpp"
#include "bound/shape_difference.hpp"
#include "number/infinity.hpp"

namespace kinesphere {

namespace {

/// Returns the nearest point of a shape and, of a mesh, its triangle.
MeshPoint nearest_of(const Shape& shape, const Vec3& from) {
  return std::visit(
      [&]<class Solid>(const Solid& solid) -> MeshPoint {
        if constexpr (std::is_same_v<Solid, Ball>) {
          return {};  // a ball is handled as a sphere
        } else if constexpr (std::is_same_v<Solid, Mesh>) {
          return nearest_in(solid, from);
        } else {
          return {nearest_point(solid, from)};
        }
      },
      shape);
}

/// Sets normal, gap and point of an event between two spheres. Coinciding centres get the normal (1, 0, 0).
void describe_spheres(Event& event, double first_radius, double second_radius) {
  const Vec3 difference = event.second_state.position - event.first_state.position;
  const double distance = norm(difference);
  event.normal = distance > 0.0 ? difference / distance : Vec3{1.0, 0.0, 0.0};
  event.gap = distance - (first_radius + second_radius);
  event.point = event.first_state.position + event.normal * (first_radius + 0.5 * event.gap);
}

/// Sets normal, gap and point of an event between a sphere and a body with a shape. Either may be
/// event.first.
void describe_surface(Event& event, const Sphere& sphere, const Sphere& surface) {
  const Vec3 origin = surface.carries_shape ? surface.state.position : Vec3{};
  const auto [nearest, triangle] = nearest_of(*surface.shape, sphere.state.position - origin);
  (event.first == surface.id ? event.first_part : event.second_part) = triangle;
  event.normal = event.first == sphere.id ? -nearest.normal : nearest.normal;
  event.gap = nearest.distance - sphere.radius - surface.position_error;
  event.point = sphere.state.position - nearest.normal * (sphere.radius + 0.5 * event.gap);
}

/// Sets normal, gap, point and parts of an event between two bodies with shapes, one of which at least is
/// carried.
void describe_surfaces(Event& event, const Sphere& first, const Sphere& second, bool is_flat) {
  const Sphere& own = first.carries_shape ? first : second;
  const Sphere& other = first.carries_shape ? second : first;
  const Vec3 origin = other.carries_shape ? other.state.position : Vec3{};
  const auto [surface, own_part, other_part] =
      nearest_pieces(*own.shape, *other.shape, own.state.position - origin, is_flat);
  const bool first_is_own = &own == &first;
  event.first_part = first_is_own ? own_part : other_part;
  event.second_part = first_is_own ? other_part : own_part;
  event.normal = first_is_own ? -surface.normal : surface.normal;
  event.gap = surface.distance - (first.position_error + second.position_error);
  event.point = surface.point + origin;
}

Vec3 point_velocity(const State& state, const Vec3& spin, const Vec3& point) {
  return spin == Vec3{} ? state.velocity : state.velocity + cross(spin, point - state.position);
}
State first_at_point(const Event& event) {
  return {event.first_state.position,
          point_velocity(event.first_state, event.first_angular_velocity, event.point)};
}
State second_at_point(const Event& event) {
  return {event.second_state.position,
          point_velocity(event.second_state, event.second_angular_velocity, event.point)};
}

/// Returns the rate at which the gap of an event shrinks. `rates`: those at which the radii grow.
double approach_speed(const Event& event, double rates) {
  return dot(event.normal, first_at_point(event).velocity - second_at_point(event).velocity) + rates;
}

/// Precondition: the body is rigid.
RigidPose pose_of(const Sphere& body, const Vec3& origin = {}) {
  return {body.state.position - origin, body.rotation.orientation, body.rigid->parts, body.rigid->balls};
}

/// Returns the nearest parts of a rigid body and any other body.
NearestParts nearest_to(const Sphere& rigid, const Sphere& other) {
  const RigidPose body = pose_of(rigid);
  if (other.rigid) return nearest_parts(body, pose_of(other));
  const RigidPart ball{.radius = other.radius};
  const PartBall around = ball_around(ball);
  const auto to_ball = [&] {
    return nearest_parts(body, {other.state.position, {}, std::span(&ball, 1), std::span(&around, 1)});
  };
  if (!other.shape) return to_ball();
  const Vec3 origin = other.carries_shape ? other.state.position : Vec3{};
  return std::visit(
      [&]<class Solid>(const Solid& solid) {
        if constexpr (std::is_same_v<Solid, Ball>) {
          return to_ball();
        } else {
          NearestParts found = nearest_parts(pose_of(rigid, origin), solid);
          found.point += origin;
          return found;
        }
      },
      *other.shape);
}

/// Returns the change of the body's angular velocity by a unit impulse at the point of the event.
Vec3 spin_gain_of(const Sphere& body, const Event& event) {
  if (!body.rigid) return {};
  return body.rigid->spin_gain(body.rotation.orientation, event.point - body.state.position, event.normal);
}

/// Sets normal, gap, point and parts of an event between two bodies, at least one of which is rigid.
void describe_parts(Event& event, const Sphere& first, const Sphere& second) {
  NearestParts nearest = first.rigid ? nearest_to(first, second) : nearest_to(second, first);
  if (!first.rigid) {
    nearest.normal = -nearest.normal;
    std::swap(nearest.first_part, nearest.second_part);
  }
  event.normal = nearest.normal;
  event.gap = nearest.gap - (first.position_error + second.position_error);
  event.point = nearest.point + event.normal * (0.5 * (first.position_error - second.position_error));
  event.first_part = nearest.first_part;
  event.second_part = nearest.second_part;
  event.first_spin_gain = spin_gain_of(first, event);
  event.second_spin_gain = spin_gain_of(second, event);
}

/// Sets what the event says of its first body.
void describe_first(Event& event, const Sphere& first) {
  event.first_state = first.state;
  event.first_traits = first.traits;
  event.first_user_data = first.user_data;
  event.first_mass = first.mass;
  event.first_angular_velocity = first.rotation.angular_velocity;
}

/// Sets normal, gap, point and parts of an event between two bodies of which one at least is no ball.
/// `second_position`: that of the second one in the image that meets the first one.
void describe_shapes(Event& event, const Sphere& first, const Sphere& second, const Vec3& second_position,
                     bool is_flat) {
  Sphere seen = second;
  seen.state.position = second_position;
  if (first.rigid || second.rigid) {
    describe_parts(event, first, seen);
  } else if (first.shape && second.shape) {
    describe_surfaces(event, first, seen, is_flat);
  } else {
    describe_surface(event, first.shape ? seen : first, first.shape ? first : seen);
  }
}

/// Returns the arm of the normal of an event between two bodies (approach_error()).
double arm_of(const Event& event, const Sphere& first, const Sphere& second) {
  const auto radius = [](const Sphere& body) {
    return body.rigid ? least_radius(body.rigid->parts) + body.position_error : body.radius;
  };
  if (!first.shape && !second.shape) return event.gap + radius(first) + radius(second);
  const auto is_half_space = [](const Sphere& body) {
    return body.shape && std::holds_alternative<HalfSpace>(*body.shape);
  };
  if (is_half_space(first) || is_half_space(second)) return infinity;
  if (first.shape && second.shape) return event.gap + first.position_error + second.position_error;
  return event.gap + radius(first.shape ? second : first);
}

}  // namespace

Event contact_event(EventKind kind, double time, const Sphere& a, const Sphere& b, const Space& space) {
  const Sphere& first = a.id < b.id ? a : b;
  const Sphere& second = a.id < b.id ? b : a;
  Event event{.kind = kind, .time = time, .first = first.id, .second = second.id};
  describe(event, first, second, space);
  return event;
}

void describe(Event& event, const Sphere& first, const Sphere& second, const Space& space) {
  describe_first(event, first);
  event.second_state = second.state;
  event.second_traits = second.traits;
  event.second_user_data = second.user_data;
  event.second_mass = second.mass;
  event.second_angular_velocity = second.rotation.angular_velocity;
  if (space.repeats())
    space.move(event.second_state,
               space.shift_to_nearest(second.state.position, first.state.position, event.time));
  if (first.rigid || second.rigid || first.shape || second.shape)
    describe_shapes(event, first, second, event.second_state.position, space.is_flat());
  else
    describe_spheres(event, first.radius, second.radius);
  event.approach_speed = approach_speed(event, first.radius_rate + second.radius_rate);
}

Event wall_event(EventKind kind, double time, const Sphere& sphere, const Box& box, Wall wall) {
  Event event{.kind = kind, .time = time, .first = sphere.id, .wall = wall};
  describe(event, sphere, box);
  return event;
}

void describe(Event& event, const Sphere& sphere, const Box& box) {
  const HalfSpace inside = half_space(box, event.wall);
  describe_first(event, sphere);
  event.second_mass = infinity;
  event.normal = -inside.normal;
  if (sphere.rigid) {
    const NearestParts nearest = nearest_parts(pose_of(sphere), inside);
    event.gap = nearest.gap - sphere.position_error;
    event.point = nearest.point + event.normal * (0.5 * nearest.gap);
    event.first_part = nearest.first_part;
    event.first_spin_gain = spin_gain_of(sphere, event);
  } else {
    const double distance = dot(inside.normal, sphere.state.position) - inside.offset;
    event.gap = distance - sphere.radius;
    event.point = sphere.state.position + event.normal * distance;
  }
  event.approach_speed = approach_speed(event, sphere.radius_rate);
}

double turn(Event& event, const BodyMotion& first, const BodyMotion& second) {
  event.first_state.velocity = first.velocity;
  event.first_angular_velocity = first.spin;
  double growth = first.radius_rate, rates = std::abs(first.radius_rate);
  if (event.second != no_body) {
    event.second_state.velocity = second.velocity;
    event.second_angular_velocity = second.spin;
    growth += second.radius_rate;
    rates += std::abs(second.radius_rate);
  }
  event.approach_speed = approach_speed(event, growth);
  return rates;
}

double approach_error(const State& first, const State& second, double arm) {
  // Covers a few units in the last place, relative to the coordinates.
  constexpr double part_lost = 0x1p-49;
  const auto& [position_a, velocity_a] = first;
  const auto& [position_b, velocity_b] = second;
  const double turned = part_lost * (norm_one(position_a) + norm_one(position_b)) / std::abs(arm);
  // Two points have no arm within the tolerance, and their normal means little, so the error of the normal's
  // direction is capped: a fast approach still counts as one.
  constexpr double most_turned = 0x1p-20;
  return part_lost * (norm_one(velocity_a) + norm_one(velocity_b)) +
         (turned < most_turned ? turned : most_turned) * norm(velocity_a - velocity_b);
}

double approach_error(const Event& event, double arm, double rates) {
  if (event.first_angular_velocity == Vec3{} && event.second_angular_velocity == Vec3{})
    return approach_error(event.first_state, event.second_state, arm) + rate_error(rates);
  // What the terms of the velocities at the point lose.
  const auto lost = [&](const State& state, const Vec3& spin) {
    return norm_one(state.velocity) + norm(spin) * norm(event.point - state.position);
  };
  return approach_error(first_at_point(event), second_at_point(event), arm) +
         0x1p-49 * (lost(event.first_state, event.first_angular_velocity) +
                    lost(event.second_state, event.second_angular_velocity)) +
         rate_error(rates);
}

ContactTerms terms_of(const Event& event, const Sphere& first, const Sphere& second) {
  if (event.wall != Wall::none)
    return {first.wanted, infinity, std::abs(first.radius_rate),
            norm(first.planned_acceleration) + first.other_acceleration};
  // An acceleration that both have in common does not press.
  return {first.wanted | second.wanted, arm_of(event, first, second),
          std::abs(first.radius_rate) + std::abs(second.radius_rate),
          norm(first.planned_acceleration - second.planned_acceleration) +
              (first.other_acceleration + second.other_acceleration)};
}

Event woke_event(double time, const Sphere& sphere) {
  Event event{.kind = EventKind::woke, .time = time, .first = sphere.id};
  describe_first(event, sphere);
  event.first_state.velocity = {};
  event.point = sphere.state.position;
  return event;
}

Event violation_event(double time, const Sphere& sphere, const BoundViolation& broken,
                      double acceleration_limit) {
  Event event{.kind = EventKind::bound_violation, .time = time, .first = sphere.id};
  describe_first(event, sphere);
  event.point = sphere.state.position;
  event.position_excess = broken.position_excess;
  event.velocity_excess = broken.velocity_excess;
  event.acceleration_limit = acceleration_limit;
  return event;
}

std::optional<Box> walls_of(const WorldDefinition& definition) {
  if (!definition.box) return std::nullopt;
  Box box = *definition.box;
  bool any = false;
  for (int axis = 0; axis < 3; ++axis) {
    if (axis < definition.dimensions && !definition.periodic[axis]) {
      any = true;
    } else {
      box.lower[axis] = -infinity;
      box.upper[axis] = infinity;
    }
  }
  return any ? std::optional(box) : std::nullopt;
}

bool stands(const Box& box, Wall wall) { return std::isfinite(box.lower[(static_cast<int>(wall) - 1) / 2]); }

HalfSpace half_space(const Box& box, Wall wall) {
  const int index = static_cast<int>(wall) - 1;
  const int axis = index / 2;
  const bool upper = index % 2 == 1;
  HalfSpace inside;
  inside.normal[axis] = upper ? -1.0 : 1.0;
  inside.offset = upper ? -box.upper[axis] : box.lower[axis];
  return inside;
}

namespace {

auto delivery_order(const Event& event) {
  return std::tie(event.kind, event.first, event.second, event.wall, event.distance);
}

}  // namespace

bool delivered_before(const Event& a, const Event& b) { return delivery_order(a) < delivery_order(b); }

}  // namespace kinesphere
