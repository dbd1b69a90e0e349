// Rigid bodies drawn at random, and where they may be.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "bound/nearest_parts.hpp"
#include "bound/rigid_extent.hpp"
#include "bound/rigid_part.hpp"
#include "kinesphere/random.hpp"

namespace kinesphere {

inline constexpr double rigid_thing_now = 3.0;

/// Up to twelve balls, capsules and triangles, which report before rigid_thing_now.
struct Thing {
  std::vector<RigidPart> parts;
  std::vector<PartBall> balls;
  RigidExtent extent;

  /// `is_exact`: flies and turns exactly as reported.
  Thing(Random& random, bool is_exact, std::size_t most_parts = 12) {
    const std::size_t count = 1 + random.bits() % most_parts;
    while (parts.size() < count) {
      const Vec3 place = random.point_in_ball();
      const Vec3 ways[] = {place, place + 0.3 * random.point_in_ball(), place + 0.3 * random.point_in_ball()};
      const std::size_t points = 1 + random.bits() % 3;
      parts.push_back(hull_part(std::span(ways).first(points), 0.3 * random.uniform()));
    }
    balls = balls_around(parts);
    extent = {.bound = {.time = rigid_thing_now - random.uniform(),
                        .position = 2.0 * random.point_in_ball(),
                        .velocity = 2.0 * random.point_in_ball()},
              .parts = parts,
              .balls = balls,
              .rotation = {rotation_by(3.0 * random.point_in_ball()), 4.0 * random.point_in_ball()}};
    extent.spin = norm(extent.rotation.angular_velocity);
    for (const RigidPart& part : parts) extent.radius = std::max(extent.radius, outer_radius(part));
    extent.bound.radius = extent.radius;
    if (is_exact) return;
    extent.bound.acceleration_limit = random.uniform();
    extent.spin_growth = random.uniform();
  }
  Thing(const Thing&) = delete;
  Thing& operator=(const Thing&) = delete;

  /// The body with one of its parts.
  RigidExtent with(std::size_t part) const {
    RigidExtent alone = extent;
    alone.parts = alone.parts.subspan(part, 1);
    alone.balls = alone.balls.subspan(part, 1);
    return alone;
  }
  RigidPose pose(std::size_t from, std::size_t count) const {
    return {extent.bound.position, extent.rotation.orientation, extent.parts.subspan(from, count),
            extent.balls.subspan(from, count)};
  }

  /// Where it is at a time, if it is pushed by a part of its limit (a vector of length 1 or less), and its
  /// turning is braked by a part of its own (0 <= braking <= 1).
  RigidPose pose_at(double time, const Vec3& push, double braking) const {
    const double s = time - extent.bound.time;
    const Vec3 spin = extent.rotation.angular_velocity;
    // In two units of time it does not come to turn the other way.
    const double slower = std::min(braking * extent.spin_growth, 0.5 * extent.spin);
    const double angle = (extent.spin - 0.5 * slower * s) * s;
    const Vec3 turn = extent.spin > 0.0 ? spin * (angle / extent.spin) : Vec3{};
    return {extent.bound.centre_at(time) + push * (0.5 * extent.bound.acceleration_limit * s * s),
            after(rotation_by(turn), extent.rotation.orientation), extent.parts, extent.balls};
  }
};

}  // namespace kinesphere
