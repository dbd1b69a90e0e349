// A short part of a satellite's path: a Taylor series around the time in its middle. Lengths are in km, times
// in s.
#pragma once

#include <array>
#include <cstddef>

#include "kinesphere/body.hpp"

namespace kinesphere {

namespace earth {
// Constants of WGS-72, as element sets of satellites use them.
constexpr double gravity = 398600.8;        ///< G M (km^3 / s^2)
constexpr double radius = 6378.135;         ///< radius of the equator (km)
constexpr double oblateness = 1.082616e-3;  ///< J2
}  // namespace earth

/// Returns the gravity of a point mass and J2 at a position relative to the earth's centre (km / s^2). The
/// poles are on the z axis.
Vec3 gravity_at(const Vec3& position);

/// Returns an upper bound on gravity at this distance from the earth's centre, and farther out (km / s^2).
double largest_gravity(double distance);

/// A part of a satellite's path, from middle() - half_length to middle() + half_length.
class Arc {
 public:
  /// Time from the middle of the arc to each of its ends (s).
  static constexpr double half_length = 64.0;
  static constexpr int order = 12;

  Arc() = default;
  /// Computes the solution of Newton's equation through this state, cut off after the term of that order.
  /// Cost: about 0.4 us.
  Arc(const State& in_the_middle, double middle);

  double middle() const { return middle_; }
  double begin() const { return middle_ - half_length; }
  double end() const { return middle_ + half_length; }

  // The following take a time between begin() and end(), or a little beyond.
  Vec3 position_at(double time) const;
  State state_at(double time) const;
  Vec3 acceleration_at(double time) const;

  // Bounds that hold from begin() to end(), from the sizes of the terms.
  double largest_acceleration() const { return largest_acceleration_; }
  /// Returns a bound on the rate of change of the acceleration (km / s^3).
  double largest_jerk() const { return largest_jerk_; }
  /// Returns a lower bound on the distance from the earth's centre, with 1 m to spare (km).
  double nearest() const { return nearest_; }
  double farthest() const { return farthest_; }

 private:
  double middle_ = 0.0;
  std::array<Vec3, order + 1> terms_{};  ///< of the position, in powers of time - middle
  double largest_acceleration_ = 0.0;
  double largest_jerk_ = 0.0;
  double nearest_ = 0.0;
  double farthest_ = 0.0;
};

}  // namespace kinesphere
