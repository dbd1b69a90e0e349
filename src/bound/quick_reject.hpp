// Two bounds seen from one instant on, in the engine's inner loop: do they certainly stay apart for a while,
// and if not, when may they meet?
//
// This is earliest_meeting() without its sizes: all rounding is covered by `room`, which is added to the
// radii. Where positions and ways are at most L, errors stay below 2^-49 L.
#pragma once

#include <cmath>
#include <limits>

#include "bound/rounding.hpp"
#include "kinesphere/bound.hpp"

namespace kinesphere {

/// A bound moved on to an instant; d is the time after it.
///   centre + velocity d + 1/2 acceleration d^2,   radius + speed d + 1/2 growth d^2
struct BoundAt {
  Vec3 centre, velocity, acceleration;
  double radius, speed, growth;

  [[gnu::always_inline]] BoundAt(const Bound& bound, double from)
      : acceleration(bound.planned_acceleration), growth(bound.growth_acceleration) {
    const double s = from - bound.time;
    velocity = bound.velocity;
    centre = bound.position + velocity * s;
    if (acceleration != Vec3{}) {
      centre += acceleration * (0.5 * s * s);
      velocity += acceleration * s;
    }
    radius = bound.radius + (bound.growth_speed + 0.5 * growth * s) * s;
    speed = bound.growth_speed + growth * s;
  }

  /// Around the centre of one that had moved straight on: with what has been added to the radius, and what
  /// the way has turned, by then.
  double radius_after(double d) const {
    return radius + (speed + 0.5 * (growth + norm_one(acceleration)) * d) * d;
  }
};

class QuickReject {
 public:
  [[gnu::always_inline]] QuickReject(const BoundAt& a, const BoundAt& b)
      : offset_(a.centre - b.centre),
        velocity_(a.velocity - b.velocity),
        acceleration_(a.acceleration - b.acceleration),
        radii_(a.radius + b.radius),
        speed_(a.speed + b.speed),
        growth_(a.growth + b.growth) {}

  /// No two points of the bodies come within `room` for this time. On straight lines the least of |X + V d|
  /// is |X|, its value at the end, or |X x V| / |V|: no root, no division. Radii count as they are at the
  /// end, and half of what the centres turn by then is added to them.
  [[gnu::always_inline]] bool stay_apart(double duration, double margin) const {
    // Where squares of squares underflow nothing is known.
    constexpr double least = 0x1p-400;
    const double radii =
        radii_ + margin + (speed_ + 0.5 * (growth_ + norm_one(acceleration_)) * duration) * duration;
    const double limit = radii * radii;
    const double now = norm_squared(offset_);
    if (!(now > limit && now > least)) return false;
    const double approach = -dot(offset_, velocity_);
    if (approach <= 0.0) return true;
    const double speed = norm_squared(velocity_);
    if (approach >= speed * duration) return norm_squared(offset_ + velocity_ * duration) > limit;
    return norm_squared(cross(offset_, velocity_)) > limit * speed && speed > least;
  }

  /// They come within `room` now, perhaps.
  bool is_near(double margin) const {
    const double radii = radii_ + margin;
    return !(norm_squared(offset_) > radii * radii);
  }

  /// They cannot come within `room` before this time has passed, or not within `duration` if it is +infinity.
  double meeting(double duration, double margin) const {
    const double d =
        acceleration_ == Vec3{} ? straight_meeting(duration, margin) : curved_meeting(0.0, duration, margin);
    return d > duration ? std::numeric_limits<double>::infinity() : d;
  }

 private:
  static constexpr int most_rounds = 16;
  static constexpr double negligible_gain = 0x1p-7;

  /// Of centres that go straight on: where F(d) = |X + V d|^2 - R(d)^2 first is zero. Were the growth of the
  /// radii steady, F would be a quadratic, whose root is late. If F is convex until then, the tangent there
  /// lies below F and meets zero early, and one from where it does hardly so.
  double straight_meeting(double duration, double margin) const {
    const double radii = radii_ + margin;
    const double v2 = norm_squared(velocity_);
    const double xv = dot(offset_, velocity_);
    const double latest = rounding::first_crossing(norm_squared(offset_) - radii * radii,
                                                   2.0 * (xv - radii * speed_), 2.0 * (v2 - speed_ * speed_));
    if (growth_ == 0.0) return latest;
    const auto radius = [&](double t) { return radii + (speed_ + 0.5 * growth_ * t) * t; };
    const auto speed = [&](double t) { return speed_ + growth_ * t; };
    if (latest < std::numeric_limits<double>::infinity() &&
        v2 > speed(latest) * speed(latest) + radius(latest) * growth_) {
      const auto tangent_root = [&](double t) {
        const double r = radius(t);
        return t - (norm_squared(offset_ + velocity_ * t) - r * r) / (2.0 * (xv + v2 * t - r * speed(t)));
      };
      const double first = tangent_root(latest);
      if (first > 0.0 && first <= latest) {
        const double second = tangent_root(first);
        if (second - first <= second * negligible_gain) return second;
        return curved_meeting(first, duration, margin);
      }
    }
    return curved_meeting(0.0, duration, margin);
  }

  /// As earliest_meeting() finds it, when the first d are certain; a time after `duration` may be any.
  double curved_meeting(double d, double duration, double margin) const {
    const double radii = radii_ + margin;
    for (int round = 0; round < most_rounds; ++round) {
      const Vec3 centre = offset_ + (velocity_ + acceleration_ * (0.5 * d)) * d;
      // Where its square underflows there is no unit vector. With none, |C(d)| >= 0 remains.
      const double measured = norm(centre);
      const double length = measured > 0x1p-500 ? measured : 0.0;
      const Vec3 n = length > 0.0 ? centre * (1.0 / length) : Vec3{};
      const double gain = rounding::first_crossing(
          length - radii - (speed_ + 0.5 * growth_ * d) * d,
          dot(n, velocity_ + acceleration_ * d) - (speed_ + growth_ * d), dot(n, acceleration_) - growth_);
      d += gain;
      if (d > duration || !(gain > d * negligible_gain)) break;
    }
    return d;
  }

  Vec3 offset_, velocity_, acceleration_;
  double radii_, speed_, growth_;
};

}  // namespace kinesphere
