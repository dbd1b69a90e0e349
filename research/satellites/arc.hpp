// A short part of a satellite's path: a Taylor series around the time in its middle. Lengths in km, times in
// s.
#pragma once

#include <array>
#include <cstddef>

#include "kinesphere/body.hpp"

namespace kinesphere {

namespace earth {
// WGS-72, as element sets of satellites use it.
constexpr double gravity = 398600.8;        ///< G M (km^3 / s^2)
constexpr double radius = 6378.135;         ///< of the equator (km)
constexpr double oblateness = 1.082616e-3;  ///< J2
}  // namespace earth

/// Of a point mass and J2, at a place from the earth's centre; the poles are on the z axis.
Vec3 gravity_at(const Vec3& position);

/// At no place farther from the earth's centre it is larger.
double largest_gravity(double distance);

class Arc {
 public:
  /// From `half_length` before its middle to `half_length` after it.
  static constexpr double half_length = 64.0;
  static constexpr int order = 12;

  Arc() = default;
  /// The solution of Newton's equation through this state, cut off behind the term of that order. Cost: about
  /// 0.4 us.
  Arc(const State& in_the_middle, double middle);

  double middle() const { return middle_; }
  double begin() const { return middle_ - half_length; }
  double end() const { return middle_ + half_length; }

  // At a time between begin() and end(), or a little beyond.
  Vec3 position_at(double time) const;
  State state_at(double time) const;
  Vec3 acceleration_at(double time) const;

  // Limits that hold all the time from begin() to end(): from the sizes of the terms.
  double largest_acceleration() const { return largest_acceleration_; }
  /// Of the acceleration's rate of change.
  double largest_jerk() const { return largest_jerk_; }
  /// From the earth's centre, with 1 m to spare.
  double nearest() const { return nearest_; }
  double farthest() const { return farthest_; }

 private:
  double middle_ = 0.0;
  std::array<Vec3, order + 1> terms_{};  ///< of the position, by powers of the time from the middle
  double largest_acceleration_ = 0.0;
  double largest_jerk_ = 0.0;
  double nearest_ = 0.0;
  double farthest_ = 0.0;
};

}  // namespace kinesphere
