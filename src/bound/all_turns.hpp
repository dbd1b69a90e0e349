// Certificates of bodies that make many turns: what holds in every turn does not depend on time.
//
// A body that keeps its angular velocity turns about an axis of fixed direction through its position. A point
// that is fixed in it stays on a circle around a place on that axis. Along a direction n it never reaches
// farther than the centre of the circle does, plus the radius times the length of the part of n normal to the
// axis. Steps from one rotation to the next would be as many as there are turns.
#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "bound/convex.hpp"
#include "bound/placed.hpp"
#include "bound/rigid_extent.hpp"
#include "bound/rigid_part.hpp"
#include "number/infinity.hpp"

namespace kinesphere {

/// A rigid body in all its turns.
class AllTurns {
 public:
  explicit AllTurns(const RigidExtent& body)
      : body_(body), lost_(rounding::margin * (body.radius + body.bound.radius)) {
    const Vec3& spin = body.rotation.angular_velocity;
    const double speed = norm(spin);
    // Slower spins have no exact direction, as their squares underflow.
    if (body.spin_growth == 0.0 && speed > 0x1p-400) axis_ = spin / speed;
    has_axis_ = axis_ != Vec3{} || (body.spin_growth == 0.0 && spin == Vec3{});
  }

  const Vec3& axis() const { return axis_; }
  /// Bound of a ball that, along a direction of length 1, always reaches at least as far back as the body.
  Bound hindmost(const Vec3& direction) const {
    const double across = has_axis_ ? norm(direction - axis_ * dot(axis_, direction)) : 1.0;
    double least = infinity;
    Bound found = body_.bound;
    for_each_circle([&](const Vec3& centre, double radius, double ball_radius) {
      const double reach = radius * across + ball_radius;
      const double along = dot(direction, centre) - reach;
      if (!(along < least)) return;
      least = along;
      found = bound_of(centre, reach + lost_);
    });
    return found;
  }
  /// Calls visit(bound, radius) for points of the body: the bound of the centre of the circle on which the
  /// point stays, with the radius of the part, and the circle's radius.
  template <class Visit>
  void for_each_orbit(Visit visit) const {
    for_each_circle([&](const Vec3& centre, double radius, double ball_radius) {
      visit(bound_of(centre, ball_radius), radius + lost_);
    });
  }

 private:
  /// Calls visit(centre, radius, ball_radius) for the points of the parts and the middles of these.
  template <class Visit>
  void for_each_circle(Visit visit) const {
    const auto visit_point = [&](const Vec3& point, double ball_radius) {
      const Vec3 arm = rotated(body_.rotation.orientation, point);
      const Vec3 centre = !has_axis_ ? Vec3{} : axis_ == Vec3{} ? arm : axis_ * dot(axis_, arm);
      visit(centre, norm(arm - centre), ball_radius);
    };
    for (const RigidPart& part : body_.parts) {
      for (std::size_t k = 0; k < point_count(part); ++k) visit_point(point_of(part, k), part.radius);
      if (point_count(part) > 1) visit_point(BallAroundPoints(part).middle, part.radius);
    }
  }
  Bound bound_of(const Vec3& centre, double radius) const {
    Bound bound = body_.bound;
    bound.position += centre;
    bound.radius += radius - body_.radius;
    return bound;
  }

  const RigidExtent& body_;
  double lost_;  ///< to rounding (length)
  Vec3 axis_{};  ///< of length 1; zero if the body does not turn or has none
  bool has_axis_;
};

/// The motion of two along a direction in all their turns: that of a bound beside a plane.
struct MotionAlong {
  BoundBesideBound motion;
  HalfSpace plane;
};
inline MotionAlong motion_along(const Vec3& direction, const Bound& own, const RigidExtent& other,
                                double time) {
  return {{own, AllTurns(other).hindmost(-direction), time}, {direction, 0.0}};
}
template <class Solid>
MotionAlong motion_along(const Vec3& direction, const Bound& own, const Placed<Solid>& shape, double time) {
  return {shape.beside(own, time), supporting_plane(shape.solid, direction)};
}
inline MotionAlong motion_along(const Vec3&, const Bound& own, const HalfSpace& wall, double) {
  return {BoundBesideBound(own), wall};
}

/// Calls visit(direction) for directions of length 1 in some of which two may be apart in all their turns:
/// between `way`, from the partner to the body, and the axis of one of them.
template <class Visit>
void for_each_way(const Vec3& way, const Vec3& axis, Visit visit) {
  constexpr int ways = 8;
  const double along = dot(axis, way);
  const Vec3 across = way - axis * along;
  const double length = norm(across);
  if (axis == Vec3{} || !(length > 0x1p-20)) return visit(way);
  for (int k = 0; k <= ways; ++k) {
    const Vec3 between = axis * std::copysign(ways - k, along) + across * (k / length);
    visit(between / norm(between));
  }
}
template <class Visit>
void for_each_way(const RigidPair<RigidExtent>& pair, double time, Visit visit) {
  const Vec3 between = pair.body.bound.centre_at(time) - pair.other.bound.centre_at(time);
  const double length = norm(between);
  if (!(length > 0.0)) return;
  for (const RigidExtent* const body : {&pair.body, &pair.other})
    for_each_way(between / length, AllTurns(*body).axis(), visit);
}
template <class Visit>
void for_each_way(const RigidPair<HalfSpace>& pair, double, Visit visit) {
  visit(pair.other.normal);
}
template <class Solid, class Visit>
void for_each_way(const RigidPair<Placed<Solid>>& pair, double time, Visit visit) {
  const Vec3 from = pair.body.bound.centre_at(time) - pair.other.origin(time);
  for_each_way(nearest_point(pair.other.solid, from).normal, AllTurns(pair.body).axis(), visit);
}

/// Like earliest_meeting(), of two in all their turns. Hulls do not know how deep they overlap, so it is at
/// the latest when they overlap by the least radii.
template <class Other>
double earliest_meeting_in_all_turns(const RigidPair<Other>& pair, double from, double until,
                                     double distance) {
  double deepest = -least_radius(pair.body.parts);
  if constexpr (std::is_same_v<Other, RigidExtent>) deepest -= least_radius(pair.other.parts);
  distance = std::max(distance, deepest);
  double latest = from;
  const AllTurns body(pair.body);
  for_each_way(pair, from, [&](const Vec3& direction) {
    const auto [motion, plane] = motion_along(direction, body.hindmost(direction), pair.other, from);
    latest = std::max(latest, earliest_meeting(motion.bound, plane, from, until, distance + motion.slack));
  });
  return latest;
}

/// Like earliest_separation(), of two in all their turns.
inline double earliest_separation_in_all_turns(const RigidPair<RigidExtent>& pair, double from, double until,
                                               double distance) {
  double latest = from;
  const AllTurns partner(pair.other);
  AllTurns(pair.body).for_each_orbit([&](const Bound& own, double radius) {
    partner.for_each_orbit([&](const Bound& other, double other_radius) {
      if (latest < infinity)
        latest = std::max(latest,
                          earliest_separation(own, other, from, until, distance - (radius + other_radius)));
    });
  });
  return latest;
}
template <class Shape>
double earliest_separation_in_all_turns(const RigidPair<Shape>& pair, double from, double until,
                                        double distance) {
  double latest = from;
  AllTurns(pair.body).for_each_orbit([&](const Bound& own, double radius) {
    latest = std::max(latest, earliest_separation(own, pair.other, from, until, distance - radius));
  });
  return latest;
}

}  // namespace kinesphere
