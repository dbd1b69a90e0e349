// The parts of a rigid body and its rotation as last reported.
#pragma once

#include <algorithm>
#include <concepts>
#include <span>
#include <tuple>
#include <type_traits>
#include <vector>

#include "bound/rigid_part.hpp"
#include "bound/rounding.hpp"
#include "kinesphere/rigid_body.hpp"

namespace kinesphere {
class HeapCounter;

/// Returns true for the parts of a body that is a ball around its position.
inline bool is_round(std::span<const RigidPart> parts) {
  return parts.size() == 1 && parts[0].more.empty() && parts[0].a == Vec3{} && parts[0].b == Vec3{};
}

/// A rigid body, but for its position.
struct RigidRecord {
  std::vector<RigidPart> parts;
  std::vector<PartBall> balls;  ///< balls_around(parts)
  Rotation rotation{};          ///< at the time of the body's bound
  double angular_acceleration_limit = 0.0;
  double largest_angular_speed = 0.0;
  Vec3 inertia{};
  // The rotation at the last change or, with a RotationProbe, the last report. A body that keeps its angular
  // velocity turns from there on, so that its rotation does not depend on when it is probed.
  Rotation origin{};
  double origin_time = 0.0;
  bool is_changed = false;  ///< `rotation` is from before the last change, until the next report

  bool is_round() const { return kinesphere::is_round(parts); }
  bool keeps_spin() const { return angular_acceleration_limit == 0.0; }
  /// Returns the largest angular speed until the next change (radians / time).
  double spin() const {
    const double now = norm(rotation.angular_velocity) * (1.0 + rounding::margin);
    return keeps_spin() ? now : std::max(now, largest_angular_speed);
  }
  /// Returns the largest acceleration of a point of the body beyond that of its position, after a change too.
  double surface_acceleration(double radius) const {
    const double fastest = std::max(spin(), norm(origin.angular_velocity));
    return (angular_acceleration_limit + fastest * fastest) * radius;
  }
  /// Returns the rotation at a time not before the origin, if the angular velocity stays.
  Rotation at(double time) const {
    return {after(rotation_by(origin.angular_velocity * (time - origin_time)), origin.orientation),
            origin.angular_velocity};
  }
  /// Returns the rotation so long after the last report, if the angular velocity stays.
  Rotation after_report(double duration) const {
    if (duration == 0.0) return rotation;
    return {after(rotation_by(rotation.angular_velocity * duration), rotation.orientation),
            rotation.angular_velocity};
  }
  /// Takes the rotation of a report.
  void report(const Rotation& now, double time) {
    rotation = now;
    is_changed = false;
    if (!keeps_spin() || norm(now.angular_velocity) * (time - origin_time) > most_turned) renew(now, time);
  }
  /// Takes a rotation that the caller sets. `is_fresh`: the state of the body is known at that time.
  void change(const Rotation& now, double time, bool is_fresh) {
    renew(now, time);
    if (is_fresh) rotation = now;
    is_changed = !is_fresh;
  }
  /// Returns the change of angular velocity by a unit impulse along `direction` at `arm` from the position of
  /// the body in this orientation.
  Vec3 spin_gain(const Quaternion& orientation, const Vec3& arm, const Vec3& direction) const;

  static void serialize(auto& self, auto& archive) {
    auto& [parts, balls, rotation, angular_acceleration_limit, largest_angular_speed, inertia, origin,
           origin_time, is_changed] = self;
    archive(parts, rotation, angular_acceleration_limit, largest_angular_speed, inertia, origin, origin_time,
            is_changed);
    if constexpr (std::same_as<std::remove_reference_t<decltype(archive)>, HeapCounter>)
      archive(balls);
    else if constexpr (!std::is_const_v<std::remove_reference_t<decltype(self)>>)
      balls = balls_around(parts);
  }

 private:
  /// Largest angle (radians) from the origin: rounding of larger ones would turn the body by 10^-12.
  static constexpr double most_turned = 4096.0;

  void renew(const Rotation& now, double time) {
    origin = now;
    origin_time = time;
  }
};

}  // namespace kinesphere
