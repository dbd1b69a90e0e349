// The true rotation of a rigid body since a time: about an axis, with a constant angular acceleration.
#pragma once

#include "kinesphere/rigid_body.hpp"

namespace kinesphere {

struct Spin {
  double since = 0.0;
  Quaternion orientation{};
  Vec3 axis{0, 0, 1};
  double speed = 0.0;         ///< radians / time
  double acceleration = 0.0;  ///< radians / time^2

  double speed_at(double time) const { return speed + acceleration * (time - since); }
  Rotation at(double time) const {
    const double s = time - since;
    return {after(rotation_by(axis * ((speed + 0.5 * acceleration * s) * s)), orientation),
            axis * speed_at(time)};
  }
};

}  // namespace kinesphere
