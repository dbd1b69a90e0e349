// What the functions of rigid bodies need of a part: its points and the ball around it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "bound/rigid_extent.hpp"
#include "kinesphere/rigid_body.hpp"

namespace kinesphere {

[[gnu::always_inline]] inline bool is_hull(const RigidPart& part) { return !part.more.empty(); }
[[gnu::always_inline]] inline bool is_ball(const RigidPart& part) {
  return part.a == part.b && !is_hull(part);
}

/// Number of points of which the part is the hull.
inline std::size_t point_count(const RigidPart& part) { return is_ball(part) ? 1 : 2 + part.more.size(); }
inline const Vec3& point_of(const RigidPart& part, std::size_t number) {
  return number == 0 ? part.a : number == 1 ? part.b : part.more[number - 2];
}

/// Returns the largest distance of a point of the part from the origin, without rounding margin.
inline double outer_radius(const RigidPart& part) {
  double farthest = std::max(norm(part.a), norm(part.b));
  for (const Vec3& point : part.more) farthest = std::max(farthest, norm(point));
  return farthest + part.radius;
}

/// Returns the least radius of the parts (length).
inline double least_radius(std::span<const RigidPart> parts) {
  double least = parts.front().radius;
  for (const RigidPart& part : parts) least = std::min(least, part.radius);
  return least;
}

/// A ball around points, without rounding margin.
struct BallAroundPoints {
  Vec3 middle;
  double reach = 0.0;  ///< radius

  template <class PointAt>
  BallAroundPoints(std::size_t count, PointAt point_at) {
    if (count == 1) {
      middle = point_at(0);
    } else if (count == 2) {
      middle = 0.5 * (point_at(0) + point_at(1));
      reach = 0.5 * norm(point_at(1) - point_at(0));
    } else {
      for (std::size_t k = 0; k < count; ++k) middle += point_at(k);
      middle = middle / static_cast<double>(count);
      for (std::size_t k = 0; k < count; ++k) reach = std::max(reach, norm(point_at(k) - middle));
    }
  }
  explicit BallAroundPoints(const RigidPart& part)
      : BallAroundPoints(point_count(part), [&](std::size_t k) { return point_of(part, k); }) {}
};

inline PartBall ball_around(const RigidPart& part) {
  const BallAroundPoints points(part);
  return {points.middle, norm(points.middle), points.reach + part.radius};
}
inline std::vector<PartBall> balls_around(std::span<const RigidPart> parts) {
  std::vector<PartBall> balls;
  balls.reserve(parts.size());
  for (const RigidPart& part : parts) balls.push_back(ball_around(part));
  return balls;
}

}  // namespace kinesphere
