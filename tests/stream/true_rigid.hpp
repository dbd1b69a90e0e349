// The truth about a rigid body: its parts, and how it turns.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "kinesphere/rigid_body.hpp"
#include "number/infinity.hpp"
#include "support/placed_parts.hpp"

namespace kinesphere::stream {

/// A rotation about one axis since a time: at a constant speed, and to and fro on top of that.
struct Turning {
  static constexpr double pace = 8.0;  ///< of the swing (radians / time)
  double since = 0.0;
  Rotation start{};
  Vec3 swing{};  ///< angular acceleration at the start, parallel to the angular velocity

  Rotation at(double time) const {
    const double s = time - since;
    const Vec3 extra = swing * ((1.0 - std::cos(pace * s)) / (pace * pace));
    return {after(rotation_by(start.angular_velocity * s + extra), start.orientation),
            start.angular_velocity + swing * (std::sin(pace * s) / pace)};
  }
};

struct Range {
  double least = infinity;
  double greatest = -infinity;

  void include(double value) {
    least = std::min(least, value);
    greatest = std::max(greatest, value);
  }
};

struct TrueRigid {
  std::vector<RigidPart> parts;
  std::vector<true_hulls::Hull> hulls;  ///< of the parts
  double angular_acceleration_limit;
  double largest_angular_speed;
  Turning turning{};
  /// Limits that the acceleration of its position has had since it was added, and what turning has added to
  /// that of its points: the world may know earlier ones.
  Range accelerations{};
  Range turning_accelerations{};

  explicit TrueRigid(const RigidBody& body, double now)
      : parts(body.parts),
        angular_acceleration_limit(body.angular_acceleration_limit),
        largest_angular_speed(body.largest_angular_speed),
        turning{now, body.rotation} {
    for (const RigidPart& part : parts) hulls.emplace_back(placed_parts::points_of(part));
  }
  bool keeps_spin() const { return angular_acceleration_limit == 0.0; }
  /// Returns the largest angular speed until the next change.
  double spin() const { return keeps_spin() ? norm(turning.start.angular_velocity) : largest_angular_speed; }
};

}  // namespace kinesphere::stream
