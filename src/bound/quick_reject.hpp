// Quick rejection of a pair of bounds, in the engine's inner loop: are they certainly apart for a duration,
// and if not, when may they meet?
//
// This is earliest_meeting() without rounding sizes. All rounding is covered by the parameter `margin`
// (length), which is added to the radii. Precondition: with positions and displacements up to L, errors stay
// below 2^-49 L, so `margin` must be at least that.
#pragma once

#include <limits>

#include "bound/rounding.hpp"
#include "kinesphere/bound.hpp"

namespace kinesphere {

/// A bound advanced to time `from`, as functions of the time d after it:
///   centre + velocity d + 1/2 acceleration d^2,   radius + speed d + 1/2 growth d^2
struct BoundAt {
  Vec3 centre, velocity, acceleration;
  double radius, speed, growth;

  BoundAt(const Vec3& centre_now, const Vec3& velocity_now, const Vec3& acceleration_now, double radius_now,
          double speed_now, double growth_now)
      : centre(centre_now),
        velocity(velocity_now),
        acceleration(acceleration_now),
        radius(radius_now),
        speed(speed_now),
        growth(growth_now) {}
  [[gnu::always_inline]] BoundAt(const Bound& bound, double from)
      : acceleration(bound.planned_acceleration), growth(bound.acceleration_limit) {
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

  /// True if the radius does not grow.
  bool is_exact() const { return speed == 0.0 && growth == 0.0; }

  /// Radius at time d of a sphere around centre + velocity d that contains the bound: the grown radius plus
  /// the deviation of the centre from a straight line.
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

  /// True if no two points of the bodies come within `margin` during `duration`. Conservative: false means
  /// unknown. Neither root nor division is needed, and 1/2 |A| d^2 is added to the radii for the curvature of
  /// the relative path. With radii as at the end: on straight lines, the minimum of |X + V d| is |X|, its
  /// value at the end, or |X x V| / |V|. With radii as they grow: |X + V d| is at least |X| + d (X V) / |X|,
  /// and since this less the radii is a concave function, it is positive throughout if it is so at both ends.
  [[gnu::always_inline]] bool stay_apart(double duration, double margin) const {
    // Below this, products of squares underflow, and the answer is unknown.
    constexpr double least = 0x1p-400;
    const double radii =
        radii_ + margin + (speed_ + 0.5 * (growth_ + norm_one(acceleration_)) * duration) * duration;
    const double limit = radii * radii;
    const double now = norm_squared(offset_);
    if (!(now > (radii_ + margin) * (radii_ + margin) && now > least)) return false;
    const double approach = -dot(offset_, velocity_);
    const double along = now - approach * duration;
    if (along > 0.0 && along * along > limit * now) return true;
    if (!(now > limit)) return false;
    const double speed = norm_squared(velocity_);
    if (approach >= speed * duration) return norm_squared(offset_ + velocity_ * duration) > limit;
    return norm_squared(cross(offset_, velocity_)) > limit * speed && speed > least;
  }

  /// True if the bodies may be within `margin` now.
  bool is_near(double margin) const {
    const double radii = radii_ + margin;
    return !(norm_squared(offset_) > radii * radii);
  }

  /// Returns a time d before which the bodies cannot come within `margin`; +infinity if they cannot within
  /// `duration`.
  double meeting(double duration, double margin) const {
    const double d =
        acceleration_ == Vec3{} ? straight_meeting(duration, margin) : curved_meeting(0.0, duration, margin);
    return d > duration ? std::numeric_limits<double>::infinity() : d;
  }

 private:
  /// Limits of the iteration in curved_meeting(): more rounds and a smaller least gain, relative to the
  /// total, give later times for more work. Any values are safe.
  static constexpr int most_rounds = 16;
  static constexpr double negligible_gain = 0x1p-7;

  /// Solves for centres on straight lines: the first zero of F(d) = |X + V d|^2 - R(d)^2. With R growing at
  /// constant speed, F would be a quadratic; its root `latest` is too late, as R grows faster. If F is convex
  /// up to there, the tangent at `latest` lies below F, so its zero is early. The tangent from that zero is
  /// hardly early.
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

  /// Iterates like earliest_meeting(), starting from a certified time d. If the result exceeds `duration`, it
  /// only means that the bodies do not meet within `duration`.
  double curved_meeting(double d, double duration, double margin) const {
    const double radii = radii_ + margin;
    for (int round = 0; round < most_rounds; ++round) {
      const Vec3 centre = offset_ + (velocity_ + acceleration_ * (0.5 * d)) * d;
      // If the squared length underflows, there is no unit vector. Without one, |C(d)| >= 0 is used.
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
