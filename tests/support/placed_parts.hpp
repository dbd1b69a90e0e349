// Gaps of parts of rigid bodies, where they are, by other formulas than the library's.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>
#include <vector>

#include "kinesphere/rigid_body.hpp"
#include "kinesphere/shape.hpp"
#include "number/infinity.hpp"
#include "support/true_hulls.hpp"

namespace kinesphere::placed_parts {

struct Axis {
  Vec3 a, b;
  double radius;
};

inline double point_to_segment(const Vec3& point, const Axis& axis) {
  const Vec3 way = axis.b - axis.a;
  const double square = norm_squared(way);
  const double part = square > 0.0 ? std::clamp(dot(point - axis.a, way) / square, 0.0, 1.0) : 0.0;
  return norm(point - (axis.a + way * part));
}

/// The squared distance is convex in the two positions, so its least is at an edge of the unit square or
/// where both derivatives are zero.
inline double segment_distance(const Axis& p, const Axis& q) {
  double least = std::min({point_to_segment(p.a, q), point_to_segment(p.b, q), point_to_segment(q.a, p),
                           point_to_segment(q.b, p)});
  const Vec3 u = p.b - p.a;
  const Vec3 v = q.b - q.a;
  const Vec3 across = cross(u, v);
  const double square = norm_squared(across);
  if (square == 0.0) return least;
  const Vec3 between = q.a - p.a;
  const double s = dot(cross(between, v), across) / square;
  const double t = dot(cross(between, u), across) / square;
  if (s >= 0.0 && s <= 1.0 && t >= 0.0 && t <= 1.0)
    least = std::min(least, std::abs(dot(between, across)) / std::sqrt(square));
  return least;
}

inline double distance_of(const Shape& shape, const Vec3& from) {
  return std::visit(
      [&]<class Solid>(const Solid& solid) {
        if constexpr (std::is_same_v<Solid, Ball>)
          return norm(from - solid.centre) - solid.radius;
        else
          return nearest_point(solid, from).distance;
      },
      shape);
}

inline std::vector<Vec3> points_of(const RigidPart& part) {
  std::vector<Vec3> points{part.a};
  if (part.b != part.a) points.push_back(part.b);
  points.insert(points.end(), part.more.begin(), part.more.end());
  return points;
}

/// A part where it is.
struct PlacedPart {
  Axis axis;
  const true_hulls::Hull* hull;
  bool is_hull;
  std::vector<Vec3> points;
  Vec3 middle{};
  double reach = 0.0;  ///< of the ball around the middle that contains the part

  PlacedPart(const RigidPart& part, const true_hulls::Hull& known, const Vec3& position,
             const Quaternion& orientation)
      : hull(&known), is_hull(!part.more.empty()), points(points_of(part)) {
    for (Vec3& point : points) point = position + rotated(orientation, point);
    axis = {points.front(), points.back(), part.radius};
    for (const Vec3& point : points) middle += point / static_cast<double>(points.size());
    for (const Vec3& point : points) reach = std::max(reach, norm(point - middle) + part.radius);
  }

  double distance(const true_hulls::Hull& other, std::vector<Vec3> there, double enough) const {
    return true_hulls::signed_distance({*hull, points}, {other, std::move(there)}, enough);
  }
};

/// `is_deep`: the distance of overlapping hulls is minus their depth, and not 0. Beyond `enough`, a lower
/// limit will do.
inline double gap_of(const PlacedPart& one, const PlacedPart& other, bool is_deep, double enough) {
  const double radii = one.axis.radius + other.axis.radius;
  if (!one.is_hull && !other.is_hull) return segment_distance(one.axis, other.axis) - radii;
  const double distance = one.distance(*other.hull, other.points, enough + radii);
  return (is_deep ? distance : std::max(distance, 0.0)) - radii;
}

/// Exact, however deep the part is in the half-space.
inline double gap_of(const PlacedPart& part, const HalfSpace& space) {
  double least = infinity;
  for (const Vec3& point : part.points) least = std::min(least, dot(space.normal, point) - space.offset);
  return least - part.axis.radius;
}

inline double gap_of(const PlacedPart& part, const Shape& shape, const Vec3& origin, bool is_deep,
                     double enough) {
  if (const auto* mesh = std::get_if<Mesh>(&shape)) {
    double least = infinity;
    for (std::size_t k = 0; k < mesh->size(); ++k)
      least = std::min(least, gap_of(part, mesh->triangle(k), origin, is_deep, enough));
    return least;
  }
  if (const auto* space = std::get_if<HalfSpace>(&shape)) return gap_of(part, *space);
  if (part.points.size() == 1) return distance_of(shape, part.points[0] - origin) - part.axis.radius;
  if (const auto* ball = std::get_if<Ball>(&shape)) {
    const true_hulls::Hull point{std::vector<Vec3>(1)};
    return gap_of(part, PlacedPart({.radius = ball->radius}, point, origin + ball->centre, {}), is_deep,
                  enough);
  }
  const auto* triangle = std::get_if<Triangle>(&shape);
  std::vector<Vec3> points = triangle ? std::vector{triangle->a, triangle->b, triangle->c}
                                      : points_of(box_part(std::get<Box>(shape), 0.0));
  const true_hulls::Hull solid(points);
  for (Vec3& point : points) point += origin;
  const double distance = part.distance(solid, points, enough + part.axis.radius);
  return (is_deep ? distance : std::max(distance, 0.0)) - part.axis.radius;
}

}  // namespace kinesphere::placed_parts
