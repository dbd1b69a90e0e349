// Shapes of bodies, and certified times at which a moving body can meet them.
//
//   const BodyId floor = world.add_static({.shape = HalfSpace{{0, 0, 1}, 0.0}}).value();
//   const BodyId step = world.add_static({.shape = Box{{0, 0, 0}, {2, 1, 0.2}}}).value();
//   const auto hill = world.add_static_all(mesh(vertices, corners).value()).value();
//   const BodyId lift = world.add_moving_shape({{.velocity = {0, 0, 1}, .mass = inf}, Box{{-3, -3, -0.2}, {3,
//   3, 0}}}).value();
//
// All shapes are convex, and none turns; the functions below take shapes at rest. For a convex shape and any
// direction, however computed, two facts hold. The shape lies behind its supporting plane in that direction,
// so a body that stays in front of the plane does not meet it. The distance of a body from the shape is at
// most its distance from any point that stays in the shape. The certificates below follow from these two
// facts, with the margins that bound.hpp describes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <variant>
#include <vector>

#include "kinesphere/bound.hpp"
#include "kinesphere/filter.hpp"
#include "kinesphere/result.hpp"
#include "kinesphere/sensor.hpp"

namespace kinesphere {

/// A solid ball.
struct Ball {
  Vec3 centre{};
  double radius = 1.0;  ///< >= 0 (length)

  friend constexpr bool operator==(const Ball&, const Ball&) = default;
};

/// Two-sided triangle without thickness. A body without a response passes through it. A body that bounces
/// off it should have a radius of more than two contact tolerances, the largest depth that it can reach.
struct Triangle {
  Vec3 a{};
  Vec3 b{};
  Vec3 c{};

  friend constexpr bool operator==(const Triangle&, const Triangle&) = default;
};

/// Shape of a static body, or of one that carries it. A Box is solid, and so is the side of a HalfSpace where
/// bodies may not be.
using Shape = std::variant<Ball, HalfSpace, Box, Triangle>;

/// Definition of a body that never moves: World::add_static().
struct StaticDefinition {
  Shape shape{};
  /// Selects the bodies that it may touch, sense and be sensed by. Two static bodies never meet.
  Filter filter{};
  /// As in BodyDefinition: false for a zone, which only senses.
  bool solid = true;
  SensorClass sensor_class = 0;
  /// Stored for the caller; the world does not interpret it.
  std::uint64_t user_data = 0;

  friend bool operator==(const StaticDefinition&, const StaticDefinition&) = default;
};

/// Definition of a body whose surface is that of a shape, which it carries along without turning it:
/// World::add_moving_shape(). Lifts, pistons, doors, paddles and walls that close in are moving shapes.
struct MovingShape {
  /// As for World::add(), with any position. The radius is replaced by that of the smallest ball around the
  /// position that contains the shape. A mass of infinity makes a body that no contact turns.
  BodyDefinition body{};
  /// A Box or a Triangle, relative to the body's position. The position should be near the middle of the
  /// shape: the world searches within that ball.
  Shape shape = Box{};

  friend bool operator==(const MovingShape&, const MovingShape&) = default;
};

/// Returns one triangle for each triple of indices into `vertices`, all with this filter; user_data is the
/// number of the triple. Errors: out_of_range for an invalid index and for a triangle
/// with two equal corners or three nearly collinear ones (its least height below 2^-20 of its longest
/// side); not_finite.
Result<std::vector<StaticDefinition>> mesh(std::span<const Vec3> vertices,
                                           std::span<const std::array<std::uint32_t, 3>> corners,
                                           const Filter& filter = {});

/// The point of a shape nearest to a given point.
struct SurfacePoint {
  /// A point on the surface of the shape, to within rounding.
  Vec3 point{};
  /// Unit vector from the shape towards the given point. For a given point on a triangle it is either
  /// normal.
  Vec3 normal{};
  /// Distance (length); negative inside a solid: minus the depth below the nearest face.
  double distance = 0.0;

  friend constexpr bool operator==(const SurfacePoint&, const SurfacePoint&) = default;
};
/// Return the point of the surface of a shape nearest to `from`. Cost: O(1).
SurfacePoint nearest_point(const HalfSpace& shape, const Vec3& from);
SurfacePoint nearest_point(const Box& shape, const Vec3& from);
SurfacePoint nearest_point(const Triangle& shape, const Vec3& from);

/// Like earliest_meeting() of two bounds (bound.hpp), with a solid box or a triangle at rest instead of the
/// second bound. Each iteration steps to the supporting plane that faces the centre; exact for a ballistic
/// body that meets a face.
double earliest_meeting(const Bound& bound, const Box& shape, double from, double until,
                        double distance = 0.0);
double earliest_meeting(const Bound& bound, const Triangle& shape, double from, double until,
                        double distance = 0.0);

/// Like earliest_separation() of two bounds. It follows a point of the shape that moves with the centre for
/// as long as it can.
double earliest_separation(const Bound& bound, const Box& shape, double from, double until, double distance);
double earliest_separation(const Bound& bound, const Triangle& shape, double from, double until,
                           double distance);

/// Like gap_limits() of two bounds (bound.hpp).
GapLimits gap_limits(const Bound& bound, const Box& shape, double t);
GapLimits gap_limits(const Bound& bound, const Triangle& shape, double t);

/// Returns the bounding box of the part of the shape within `limit` of the origin on each axis, rounded
/// outward.
Box bounding_box(const Shape& shape, double limit);

}  // namespace kinesphere
