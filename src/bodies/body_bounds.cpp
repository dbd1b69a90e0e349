#include "bodies/body_bounds.hpp"

#include "bodies/validation.hpp"

namespace kinesphere {
namespace {

/// Limits the box of a shape to eight times the coordinate limit. Bodies and their bounds, including their
/// sensor reach, stay within that.
Box cut_box(const Bodies& bodies, const Shape& shape) {
  return bounding_box(shape, 8.0 * coordinate_limit(bodies.definition()));
}

/// Radius with the position error (length), and rate of the radius (length / time).
struct Size {
  double radius;
  double rate;
};

/// Returns the size of a body now, if that of any changes with time. Out of line, for worlds where none does.
[[gnu::noinline]] Size changing_size(const Bodies& bodies, double now, std::uint32_t number) {
  const Body& body = bodies[number];
  const ChangingRadius* const changing = bodies.radii.find(number);
  if (changing == nullptr) return {body.bound.radius, 0.0};
  return {body.bound.radius + (changing->at(now) - body.radius), changing->rate_at(now)};
}

}  // namespace

Bound bound_now(const BodyDefinition& body, double now) {
  return bound_of(body, {body.position, body.velocity}, now);
}

Bound bound_with(const Bodies& bodies, std::uint32_t number, const BodyDefinition& changed, double now) {
  const Body& body = bodies[number];
  if (body.fresh(now)) return bound_of(changed, {body.bound.position, body.bound.velocity}, now);
  // The old limits held until now. The next report, which begins the new ones, comes before time advances.
  Bound bound = body.bound;
  bound.radius = changed.radius + (bound.radius - body.radius);
  return bound;
}

GapLimits gap_at(const Bodies& bodies, double now, const CollisionShape& a, const CollisionShape& b) {
  const auto limits = [now](const Bound& bound, const auto& partner) {
    return gap_limits(bound, partner, now);
  };
  const Space& space = bodies.space();
  if (!space.repeats()) return visit_shapes(a, b, limits);
  Bound nearest = b.bound;
  space.move(nearest, space.shift_to_nearest(b.bound.centre_at(now), a.bound.centre_at(now), now), now);
  return visit_shapes(a, {nearest, b.is_static, b.shape, b.carried_radius, b.rigid}, limits);
}

Sphere sphere_at(const Bodies& bodies, double now, std::uint32_t number) {
  const Body& body = bodies[number];
  const Bound& bound = body.bound;
  const RigidRecord* const turning = bodies.rigid.find(body);
  const Size size = bodies.radii.any() ? changing_size(bodies, now, number) : Size{bound.radius, 0.0};
  Sphere sphere{
      bodies.id_of(number),
      size.radius,
      {bound.centre_at(now), bound.velocity_at(now)},
      bodies.shapes.empty() ? nullptr : collision_shape_of(bodies, number).shape,
      body.carries_shape,
      body.user_data,
      bodies.masses.of(number),
      traits_of(body),
      body.contact_events,
      body.has_parts() ? turning : nullptr,
      size.rate,
      body.carries_shape || body.has_parts() ? bound.radius - body.radius : 0.0,
      turning ? turning->after_report(now - bound.time) : Rotation{},
      bound.planned_acceleration,
      bound.acceleration_limit + (body.has_parts() ? turning->surface_acceleration(body.radius) : 0.0)};
  const Space& space = bodies.space();
  if (space.repeats()) space.wrap(sphere.state, now);
  return sphere;
}

BodyMotion motion_at(const Bodies& bodies, double now, std::uint32_t number, const Vec3& place) {
  const Body& body = bodies[number];
  const RigidRecord* const turning = bodies.rigid.find(body);
  Vec3 velocity = body.bound.velocity_at(now);
  if (bodies.space().slides()) [[unlikely]]
    velocity = bodies.space().velocity_in_row(velocity, body.bound.centre_at(now), place);
  return {velocity, turning ? turning->after_report(now - body.bound.time).angular_velocity : Vec3{},
          bodies.radii.any() ? changing_size(bodies, now, number).rate : 0.0, body.contact_events};
}

Box box_now(const Bodies& bodies, const CollisionShape& extent, double now) {
  if (extent.shape && extent.is_static) return cut_box(bodies, *extent.shape);
  return bodies.space().within(swept_box(extent.bound, now, now));
}

Box box_of_static(const Bodies& bodies, std::uint32_t number) {
  const Vec3 margin = Vec3{1.0, 1.0, 1.0} * bodies.sensors.reach(bodies[number].sensor_class);
  const Box box = cut_box(bodies, bodies.shapes.of(bodies[number]));
  return bodies.space().within({box.lower - margin, box.upper + margin});
}

Bound ball_around_static(const Bodies& bodies, std::uint32_t number, double now) {
  Bound ball{.time = now, .position = bodies[number].bound.position, .radius = bodies[number].bound.radius};
  if (const Shape* shape = collision_shape_of(bodies, number).shape) {
    const Box box = bodies.space().within(cut_box(bodies, *shape));
    ball.position = 0.5 * (box.lower + box.upper);
    ball.radius = norm(0.5 * (box.upper - box.lower));
  }
  ball.radius += sensor_reach(bodies, number) + bodies.definition().contact_tolerance;
  return ball;
}

}  // namespace kinesphere
