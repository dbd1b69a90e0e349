// Shapes of bodies that never move, and when a moving body can meet them.
//
//   const BodyId floor = world.add_static({.shape = HalfSpace{{0, 0, 1}, 0.0}}).value();
//   const BodyId step = world.add_static({.shape = Box{{0, 0, 0}, {2, 1, 0.2}}}).value();
//   const auto hill = world.add_static_all(mesh(vertices, corners).value()).value();
//
// All of them are convex and at rest. Of a convex shape and any direction two things are certain, however
// the direction came about: the shape lies behind its supporting plane in that direction, so what stays
// before the plane does not meet it; and no body is farther from the shape than from a point that stays in
// it. The certificates below are made from these two, with the margins that bound.hpp describes.
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

struct Ball {
  Vec3 centre{};
  double radius = 1.0;  ///< >= 0 (length)

  friend constexpr bool operator==(const Ball&, const Ball&) = default;
};

/// Two-sided and without thickness. A body that the caller lets pass goes through it; one that is to bounce
/// off it should have a radius of more than two contact tolerances, as it is never deeper inside than that.
struct Triangle {
  Vec3 a{};
  Vec3 b{};
  Vec3 c{};

  friend constexpr bool operator==(const Triangle&, const Triangle&) = default;
};

/// A Box is solid, and so is all of space on the other side of a HalfSpace.
using Shape = std::variant<Ball, HalfSpace, Box, Triangle>;

/// A body that never moves: World::add_static.
struct StaticDefinition {
  Shape shape{};
  /// Which other bodies it may touch, sense and be sensed by. Two fixed bodies never meet.
  Filter filter{};
  /// As in BodyDefinition: one that is not solid is a zone that senses only.
  bool solid = true;
  SensorClass sensor_class = 0;
  /// For the caller: the world only keeps it.
  std::uint64_t user_data = 0;
};

/// One triangle for each triple of `corners`, which are indices of `vertices`, all with this filter;
/// user_data is the number of the triple. Errors: out_of_range for an index that is none and for a triangle
/// that has two corners in one place or all three nearly on a line (its least height below 2^-20 of its
/// longest side); not_finite.
Result<std::vector<StaticDefinition>> mesh(std::span<const Vec3> vertices,
                                           std::span<const std::array<std::uint32_t, 3>> aabb,
                                           const Filter& filter = {});

/// The nearest place of a shape.
struct SurfacePoint {
  /// In the shape, to within rounding; on its surface.
  Vec3 point{};
  /// Unit vector from the shape towards the place that was asked about. On a triangle it is either of its
  /// normals.
  Vec3 normal{};
  /// Negative inside a solid: minus the depth below the nearest face.
  double distance = 0.0;
};
SurfacePoint nearest_point(const HalfSpace& shape, const Vec3& from);
SurfacePoint nearest_point(const Box& shape, const Vec3& from);
SurfacePoint nearest_point(const Triangle& shape, const Vec3& from);

/// As for two bounds (bound.hpp), of which one is a solid box or a triangle at rest. By steps to the
/// supporting plane that faces the centre; exact for a ballistic body that meets a face.
double earliest_meeting(const Bound& bound, const Box& shape, double from, double until,
                        double distance = 0.0);
double earliest_meeting(const Bound& bound, const Triangle& shape, double from, double until,
                        double distance = 0.0);

/// As for two bounds. By a point of the shape that goes along with the centre for as long as it can.
double earliest_separation(const Bound& bound, const Box& shape, double from, double until, double distance);
double earliest_separation(const Bound& bound, const Triangle& shape, double from, double until,
                           double distance);

GapLimits gap_limits(const Bound& bound, const Box& shape, double t);
GapLimits gap_limits(const Bound& bound, const Triangle& shape, double t);

/// The box around all of the shape that lies within `limit` of the origin on each axis, rounded outward.
Box bounding_box(const Shape& shape, double limit);

}  // namespace kinesphere
